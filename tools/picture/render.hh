#pragma once

#include "tools/picture/camera.hh"
#include "tools/picture/image.hh"
#include "tools/picture/scene.hh"

namespace maille::picture {

/// Ray-traces the scene over the image: faces lit by a lamp and the sky, edges as lines of constant width,
/// and a soft shadow on the floor. Every pixel is worked out for itself, so threads don't matter.
void render(const Scene& scene, const Camera& camera, Image& image);

}  // namespace maille::picture

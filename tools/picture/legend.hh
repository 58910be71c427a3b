#pragma once

#include "tools/picture/image.hh"
#include "tools/picture/scene.hh"

namespace maille::picture {

/// Width in pixels of the column that the legend needs at the right of an image this high; 0 where there is
/// nothing to say, or no font.
int legend_width(const std::vector<Scene::LegendEntry>& entries, int image_height);

void draw_legend(const std::vector<Scene::LegendEntry>& entries, Image& image);

}  // namespace maille::picture

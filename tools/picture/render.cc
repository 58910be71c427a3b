#include "tools/picture/render.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "tools/picture/tracer.hh"

namespace maille::picture {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int samples_across = 4;   ///< rays through a pixel: the square of it
constexpr int rays_to_the_sky = 2;  ///< for each of them

/// How far the floor looks for what hides the sky; the mesh fills the unit ball.
constexpr float shadow_reach = 1.2F;

constexpr float line_width = 1.1F;
constexpr float crease_width = 2.2F;
/// Triangles lower than the first draw no lines; those higher than the second draw them in full.
constexpr float least_height = 2;
constexpr float full_height = 14;

/// Two numbers in [0, 1), evenly spread over the samples of a pixel, turned from pixel to pixel.
class Samples {
  public:
    Samples(int x, int y) {
        // A hash of the place (PCG's output function).
        std::uint32_t h =
            (static_cast<std::uint32_t>(x) * 0x9e3779b9U) ^ (static_cast<std::uint32_t>(y) * 0x85ebca6bU);
        h = ((h >> ((h >> 28) + 4)) ^ h) * 277803737U;
        h ^= h >> 22;
        turn_ = {static_cast<float>(h & 0xffff) / 65536, static_cast<float>(h >> 16) / 65536};
    }

    Vector2f next() {
        // M. Roberts' sequence R2: powers of the inverse of the plastic number.
        const auto k = static_cast<float>(++count_);
        const Vector2f p = turn_ + k * Vector2f(0.7548776662F, 0.5698402910F);
        return {p.x() - std::floor(p.x()), p.y() - std::floor(p.y())};
    }

  private:
    Vector2f turn_;
    int count_ = 0;
};

/// A direction about the normal, likelier the nearer to it (by the cosine).
Vector3f towards_sky(const Vector3f& normal, const Vector2f& sample) {
    const float angle = 2 * std::numbers::pi_v<float> * sample.x();
    const float radius = std::sqrt(sample.y());
    const Vector3f side = normal.unitOrthogonal();
    return radius * std::cos(angle) * side + radius * std::sin(angle) * normal.cross(side) +
           std::sqrt(1 - sample.y()) * normal;
}

float distance_to_segment(const Vector2f& p, const Vector2f& a, const Vector2f& b) {
    const Vector2f along = b - a;
    const float place = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-12F), 0.0F, 1.0F);
    return (p - a - place * along).norm();
}

class Renderer {
  public:
    Renderer(const Scene& scene, const Camera& camera) : scene_(scene), camera_(camera), tracer_(scene) {
        pixels_.reserve(scene.points.size());
        for (const Vector3f& p : scene.points) pixels_.push_back(camera.pixel(p));
        for (const Scene::Triangle& t : scene.triangles)
            for (std::uint32_t corner : t.corners) floor_ = std::min(floor_, scene.points[corner].z());
        const Vector3f to_eye = camera.eye().normalized();
        const Vector3f right = Vector3f::UnitZ().cross(to_eye).normalized();
        lamp_ = (to_eye - 0.75F * right + 0.7F * Vector3f::UnitZ()).normalized();
    }

    Color pixel(int x, int y) const {
        Samples samples(x, y);
        Color sum = Color::Zero();
        for (int i = 0; i < samples_across; ++i)
            for (int j = 0; j < samples_across; ++j)
                sum += color({static_cast<float>(x) + (static_cast<float>(i) + 0.5F) / samples_across,
                              static_cast<float>(y) + (static_cast<float>(j) + 0.5F) / samples_across},
                             samples);
        return sum / (samples_across * samples_across);
    }

  private:
    Color color(const Vector2f& place, Samples& samples) const {
        const Vector3f direction = camera_.direction(place);
        const auto hit = tracer_.first(camera_.eye(), direction);
        if (!hit) return floor_color(direction, samples);
        const Scene::Triangle& triangle = scene_.triangles[hit->triangle];
        const Color lit =
            triangle.color * light(triangle, camera_.eye() + hit->distance * direction, samples);
        return mix(lit, from_web(0x1c2430), ink(triangle, place));
    }

    /// The floor is white, and darker where the mesh hides the sky.
    Color floor_color(const Vector3f& direction, Samples& samples) const {
        const float drop = floor_ - 0.002F - camera_.eye().z();
        if (!(direction.z() < 0) || !(drop < 0)) return Color::Ones();
        const Vector3f place = camera_.eye() + drop / direction.z() * direction;
        if (place.head<2>().norm() > 1 + shadow_reach) return Color::Ones();
        float hidden = 0;
        for (int k = 0; k < rays_to_the_sky; ++k) {
            const auto hit =
                tracer_.first(place, towards_sky(Vector3f::UnitZ(), samples.next()), shadow_reach);
            if (hit) hidden += std::pow(1 - hit->distance / shadow_reach, 2.0F) / rays_to_the_sky;
        }
        return mix(Color::Ones(), from_web(0x303848), 0.6F * hidden);
    }

    Color light(const Scene::Triangle& t, const Vector3f& place, Samples& samples) const {
        const auto& p = scene_.points;
        Vector3f normal =
            (p[t.corners[1]] - p[t.corners[0]]).cross(p[t.corners[2]] - p[t.corners[0]]).normalized();
        if (normal.dot(camera_.eye() - place) < 0) normal = -normal;
        float open = 0;
        for (int k = 0; k < rays_to_the_sky; ++k)
            if (tracer_.is_free(place, towards_sky(normal, samples.next()))) open += 1.0F / rays_to_the_sky;
        const Color sky = mix(Color(0.80F, 0.78F, 0.76F), Color(0.96F, 0.99F, 1.04F), (normal.z() + 1) / 2);
        const float facing = std::max(0.0F, normal.dot(lamp_));
        const Vector2f blur = samples.next() - Vector2f(0.5F, 0.5F);
        const Vector3f side = lamp_.unitOrthogonal();
        const Vector3f to_lamp =
            (lamp_ + 0.25F * (blur.x() * side + blur.y() * lamp_.cross(side))).normalized();
        const float lamp = facing > 0 && tracer_.is_free(place, to_lamp) ? facing : 0;
        return (0.15F + 0.5F * open) * sky + 0.62F * lamp * Color(1.0F, 0.97F, 0.92F);
    }

    /// How much of a line covers the place: 0 to 1.
    float ink(const Scene::Triangle& t, const Vector2f& place) const {
        const std::array<Vector2f, 3> q{pixels_[t.corners[0]], pixels_[t.corners[1]], pixels_[t.corners[2]]};
        const Vector2f u = q[1] - q[0];
        const Vector2f v = q[2] - q[0];
        const float longest = std::max({u.norm(), v.norm(), (q[2] - q[1]).norm()});
        const float height = std::abs(u.x() * v.y() - u.y() * v.x()) / std::max(longest, 1e-6F);
        const float strength = std::clamp((height - least_height) / (full_height - least_height), 0.0F, 1.0F);
        float most = 0;
        for (int k = 0; k < 3; ++k) {
            const float width = t.is_crease[k] ? crease_width : line_width;
            const float cover =
                std::clamp(width / 2 + 0.5F - distance_to_segment(place, q[k], q[(k + 1) % 3]), 0.0F, 1.0F);
            most = std::max(most, cover * (t.is_crease[k] ? 0.85F : 0.7F * strength));
        }
        return most;
    }

    const Scene& scene_;
    const Camera& camera_;
    Tracer tracer_;
    std::vector<Vector2f> pixels_;
    float floor_ = 1;
    Vector3f lamp_;
};

}  // namespace

void render(const Scene& scene, const Camera& camera, Image& image) {
    const Renderer renderer(scene, camera);
    tbb::parallel_for(0, image.height, [&](int y) {
        for (int x = 0; x < image.width; ++x) image.at(x, y) = renderer.pixel(x, y);
    });
}

}  // namespace maille::picture

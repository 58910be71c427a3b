#include "tools/picture/tracer.hh"

#include <algorithm>
#include <stdexcept>

namespace maille::picture {
namespace {

constexpr float hair = 1e-4F;

RTCRay ray(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float reach) {
    RTCRay ray{};
    ray.org_x = origin.x();
    ray.org_y = origin.y();
    ray.org_z = origin.z();
    ray.dir_x = direction.x();
    ray.dir_y = direction.y();
    ray.dir_z = direction.z();
    ray.tnear = hair;
    ray.tfar = reach;
    ray.mask = 0xffffffffU;
    return ray;
}

}  // namespace

// One thread builds the tree and one instruction set serves every processor: where a ray meets an edge of two
// triangles, the same one must win always.
Tracer::Tracer(const Scene& scene) : device_(rtcNewDevice("threads=1,isa=sse2")) {
    if (!device_) throw std::runtime_error("Embree can't start");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.points.size()));
    for (const Eigen::Vector3f& p : scene.points) points = std::copy_n(p.data(), 3, points);
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), scene.triangles.size()));
    for (const Scene::Triangle& t : scene.triangles) corners = std::copy_n(t.corners.data(), 3, corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
}

Tracer::~Tracer() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::optional<Tracer::Hit> Tracer::first(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                         float reach) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{ray(origin, direction, reach), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.hit.primID, query.ray.tfar};
}

bool Tracer::is_free(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = ray(origin, direction, std::numeric_limits<float>::infinity());
    rtcOccluded1(scene_, &context, &query);
    return query.tfar >= 0;
}

}  // namespace maille::picture

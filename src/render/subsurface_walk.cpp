#include "render/subsurface_walk.h"

#include <cmath>

#include "core/sampling.h"

namespace lightsieve {
namespace {

/// Scatterings after which a walk comes out where it went in. In a white half-space one walk in thirty gets that far.
constexpr std::uint32_t kMaxSteps = 1024;
/// Scatterings before faint walks are ended by chance.
constexpr std::uint32_t kSureSteps = 8;
/// Surfaces of other objects that one step may pass.
constexpr int kMaxForeign = 16;

class Walk {
  public:
    Walk(const Scene& scene, const Surface& entry, const SubsurfaceMedium& medium,
         const Sampler& sampler, std::uint32_t stream, std::uint64_t& n_rays)
        : scene_(scene),
          entry_(entry),
          medium_(medium),
          sampler_(sampler),
          stream_(stream),
          n_rays_(n_rays) {}

    std::optional<WalkExit> run(Vec2f u_entry) {
        const Vec3f inside = -entry_.outward;
        const Vec3f axis =
            dot(entry_.at.normal, inside) < 0 ? -entry_.at.normal : entry_.at.normal;
        ray_.direction = Frame::from_z(axis).world_from_local(sample_cosine_hemisphere(u_entry));
        if (!(dot(ray_.direction, inside) > 0)) return std::nullopt;
        ray_.origin = offset_ray_origin(entry_.at.position, inside);
        ray_.time = entry_.at.time;
        for (step_ = 0; step_ < kMaxSteps; ++step_) {
            const Color odds = channel_odds();
            ray_.t_min = 0;
            ray_.t_max = distance(odds);
            RayHit hit;
            if (meets_boundary(hit)) {
                travel(hit.t, odds, false);
                return came_out(hit);
            }
            const float reached = ray_.t_max;
            travel(reached, odds, true);
            if (!survives()) return std::nullopt;
            ray_.origin = ray_.origin + ray_.direction * reached;
            ray_.direction = sample_henyey_greenstein(ray_.direction, medium_.anisotropy,
                                                      {number(2), number(3)});
        }
        return WalkExit{entry_, entry_.outward, entry_.at.normal, throughput_};
    }

  private:
    /// Uniform number `i` of this step, 0 to 4.
    [[nodiscard]] float number(std::uint32_t i) const {
        return sampler_.random(hash_combine(stream_, step_ * 8 + i));
    }
    /// Chance of each channel to decide how far the light goes.
    [[nodiscard]] Color channel_odds() const {
        const float sum = throughput_.r + throughput_.g + throughput_.b;
        return throughput_ * (1 / sum);
    }
    [[nodiscard]] float distance(Color odds) const {
        const float u = number(0);
        const int channel = u < odds.r ? 0 : u < odds.r + odds.g ? 1 : 2;
        return -std::log1p(-number(1)) * medium_.mean_free_path[channel];
    }
    /// The object's own surface before the end of the ray.
    [[nodiscard]] bool meets_boundary(RayHit& hit) {
        Ray rest = ray_;
        for (int i = 0; i < kMaxForeign; ++i) {
            ++n_rays_;
            if (!scene_.accel->intersect(rest, 0xffffffffU, hit)) return false;
            if (&scene_.objects[hit.object] == entry_.object) return true;
            rest.t_min = std::nextafter(hit.t, kInfinity);
        }
        return false;
    }
    /// Transmittance over the density of the mixture, for a distance that was reached or at which the light scattered.
    void travel(float reached, Color odds, bool scattered) {
        Color value;
        float density = 0;
        for (int c = 0; c < 3; ++c) {
            const float extinction = 1 / medium_.mean_free_path[c];
            const float transmittance = std::exp(-reached * extinction);
            // Scattered: a density over distance; the factor of scattering is albedo times extinction.
            const float pdf = scattered ? extinction * transmittance : transmittance;
            value[c] = scattered ? pdf * medium_.albedo[c] : pdf;
            density += odds[c] * pdf;
        }
        throughput_ = density > 0 ? throughput_ * value * (1 / density) : kBlack;
    }
    [[nodiscard]] bool survives() {
        const float most = max_component(throughput_);
        if (!(most > 0)) return false;
        if (step_ < kSureSteps || most >= 1) return true;
        if (number(4) >= most) return false;
        throughput_ *= 1 / most;
        return true;
    }
    [[nodiscard]] std::optional<WalkExit> came_out(const RayHit& hit) const {
        if (!(max_component(throughput_) > 0)) return std::nullopt;
        WalkExit out{make_surface(*entry_.object, ray_, hit, {}), {}, {}, throughput_};
        out.outside = -out.surface.outward;
        const Vec3f n = out.surface.at.normal;
        out.normal = dot(n, out.outside) < 0 ? -n : n;
        return out;
    }

    const Scene& scene_;
    const Surface& entry_;
    const SubsurfaceMedium& medium_;
    const Sampler& sampler_;
    std::uint32_t stream_;
    std::uint64_t& n_rays_;
    std::uint32_t step_ = 0;
    Ray ray_;
    Color throughput_ = kWhite;
};

bool has_inside(const ShapeGeometry& geometry) {
    const auto* points = std::get_if<PointList>(&geometry.data);
    return !std::holds_alternative<CurveList>(geometry.data) &&
           (points == nullptr || points->mode == PointList::Mode::Sphere);
}

}  // namespace

std::optional<WalkExit> walk_below(const Scene& scene, const Surface& entry,
                                   const SubsurfaceMedium& medium, Vec2f u_entry,
                                   const Sampler& sampler, std::uint32_t stream,
                                   std::uint64_t& n_rays) {
    // A strand or a flat particle is too thin to have an inside: light comes out where it went in.
    if (!has_inside(*entry.object->geometry))
        return WalkExit{entry, entry.outward, entry.at.normal, medium.reflectance};
    return Walk(scene, entry, medium, sampler, stream, n_rays).run(u_entry);
}

}  // namespace lightsieve

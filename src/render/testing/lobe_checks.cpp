#include "render/testing/lobe_checks.h"

#include "lpe/builtins.h"
#include "render/testing/lobe_truth.h"

namespace lightsieve::testing {
namespace {

/// Grid error of the truths below: they change by less than this when the grid is twice as fine.
constexpr double kGridError = 5e-4;

/// The first bad one of several verdicts.
class All {
  public:
    All& operator<<(Verdict v) {
        if (all_.good && !v.good) all_ = std::move(v);
        return *this;
    }
    [[nodiscard]] Verdict verdict() const { return all_; }

  private:
    Verdict all_;
};

/// Where the toy scenes are looked at from: the origin, on a plane that faces up.
const Vec3f kEye{0.45F, 0.8F, 0.25F};

/// Every pixel sees the same point, so each is an independent estimate of one number.
std::string point_camera() { return ortho_camera(kEye, {0, 0, 0}, 1e-3F); }

SeenPoint seen(const char* shape) { return {shape, {0, 0, 0}, {0, 1, 0}, normalize(kEye)}; }

/// Coat, sheen, specular and diffuse, all of them wide.
std::string layered_shader(std::string_view more = "") {
    return node("standard_surface", "layered",
                " base_color 0.7 0.4 0.2\n specular_roughness 0.45\n coat 0.8\n coat_roughness "
                "0.35\n coat_color 0.9 0.7 0.8\n sheen 0.7\n sheen_color 0.5 0.8 1\n" +
                    std::string(more));
}

const std::vector<std::string> kReflecting{"diffuse", "specular", "coat", "sheen"};

/// Each layer named `aov + suffix` has the mean `truth[aov] * light`.
Verdict compare(const Picture& picture, const LobeSums& truth,
                const std::vector<std::string>& aovs, const std::string& suffix, Color light) {
    All all;
    for (const std::string& aov : aovs) {
        all << check_lit(picture, aov + suffix);
        all << check_mean(picture, aov + suffix, truth.at(aov) * light, kGridError);
    }
    return all.verdict();
}

std::vector<std::string> with_suffix(std::vector<std::string> names, const std::string& suffix) {
    for (std::string& n : names)
        n += suffix;
    return names;
}

}  // namespace

Verdict check_lobes_under_a_quad() {
    // The light lies where the viewer sees its reflection in the plane, so that every lobe has a share of it.
    const Vec3f corner{-1.6F, 1.2F, -1.2F}, u{1.2F, 0, 0}, v{0, 0, 1.4F};
    const std::string light = node("quad_light", "key",
                                   " normalize off\n color 2 1.5 1\n vertices 4 1 VECTOR " +
                                       text_of(corner) + "  " + text_of(corner + u) + "  " +
                                       text_of(corner + u + v) + "  " + text_of(corner + v));
    const TestScene scene(frame_text(20, 20, 7, point_camera()) + layered_shader() +
                              floor("plane", 0, 1, "layered") + light,
                          in_memory(with_suffix(kReflecting, "_direct")));
    const LobeSums truth = integrate_over_quad(scene.scene(), seen("plane"), corner, u, v, 300);
    return compare(render(scene), truth, kReflecting, "_direct", {2, 1.5F, 1});
}

Verdict check_lobes_under_a_dome() {
    // The dome's picture is a checkerboard of four cells around the horizon, two above it.
    const std::string light =
        node("checkerboard", "cells",
             " color1 2 0.5 0.2\n color2 0.1 0.3 1\n u_frequency 1\n v_frequency 0") +
        node("skydome_light", "sky", " color cells\n camera 0\n resolution 64");
    const TestScene scene(frame_text(20, 20, 7, point_camera()) + layered_shader() +
                              floor("plane", 0, 1, "layered") + light,
                          in_memory(with_suffix(kReflecting, "_direct")));
    const auto radiance = [](Vec3f wi) {
        // Columns of the dome: u = 1/2 - atan2(x, z) / 2 pi; the cell at u = 0 has color2.
        const float cell = std::floor(2 * (0.5F - std::atan2(wi.x, wi.z) / (2 * kPi)));
        return static_cast<int>(cell) % 2 == 0 ? Color(0.1F, 0.3F, 1) : Color(2, 0.5F, 0.2F);
    };
    const LobeSums truth = integrate_over_sphere(scene.scene(), seen("plane"), radiance, 500);
    return compare(render(scene), truth, kReflecting, "_direct", kWhite);
}

Verdict check_lobes_on_both_sides() {
    // A thin sheet lets light through diffusely and straight, the surface of a body by rough refraction.
    const std::string
        thin =
            " thin_walled on\n subsurface 0.5\n subsurface_color 0.3 0.9 0.5\n transmission 0.4",
        body = " transmission 0.7\n specular_IOR 1.3";
    // One light above, one below; they differ in colour so that a lobe on the wrong side shows.
    const Vec3f u{1.5F, 0, 0}, v{0, 0, 1.5F}, above{-1.5F, 1.2F, -1.2F},
        below{-1.5F, -1.2F, -0.8F};
    const Color color_above(1, 0.2F, 0.1F), color_below(0.1F, 0.3F, 1);
    const auto corners = [](Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
        return " normalize off\n transmission 1\n vertices 4 1 VECTOR " + text_of(a) + "  " +
               text_of(b) + "  " + text_of(c) + "  " + text_of(d);
    };
    const std::string lights =
        node("quad_light", "top",
             corners(above, above + u, above + u + v, above + v) + "\n color 1 0.2 0.1") +
        node("quad_light", "bottom",
             corners(below, below + v, below + u + v, below + u) + "\n color 0.1 0.3 1");
    All all;
    for (const bool is_thin : {true, false}) {
        const std::string shader = node(
            "standard_surface", "sheet",
            " base_color 0.6 0.5 0.4\n transmission_color 1 0.6 0.6\n specular_roughness 0.55\n" +
                (is_thin ? thin : body));
        std::vector<std::string> aovs{"diffuse", "specular", "transmission"};
        if (is_thin) aovs.emplace_back("sss");
        const TestScene scene(frame_text(20, 20, 7, point_camera()) + shader +
                                  floor("plane", 0, 1, "sheet") + lights,
                              in_memory(with_suffix(aovs, "_direct")));
        const Picture picture = render(scene);
        const LobeSums from_above =
                           integrate_over_quad(scene.scene(), seen("plane"), above, u, v, 300),
                       from_below =
                           integrate_over_quad(scene.scene(), seen("plane"), below, u, v, 300);
        // The lower light lies straight behind the sheet.
        const LobeSums straight = mirror_weights(scene.scene(), seen("plane"));
        for (const std::string& aov : aovs)
            all << check_lit(picture, aov + "_direct")
                << check_mean(picture, aov + "_direct",
                              from_above.at(aov) * color_above +
                                  (from_below.at(aov) + straight.at(aov)) * color_below,
                              kGridError);
    }
    return all.verdict();
}

namespace {

// A wall that an unshadowed distant light makes evenly bright, above the plane that is looked at. The light travels
// upward, so that it lights the wall's lower side and not the plane's upper one.
const Vec3f kWallCorner{-2, 1.5F, -2}, kWallU{3, 0, 0}, kWallV{0, 0, 4};
constexpr float kWallAlbedo = 0.6F, kSunCosine = 0.8F;

std::string bounce_scene(const std::string& options, const std::string& wall = "") {
    return frame_text(20, 20, 7, point_camera(), options) + layered_shader() +
           floor("plane", 0, 0.2F, "layered") + node("lambert", "wall_shader", " Kd 0.6") +
           quad("wall", kWallCorner, kWallCorner + kWallU, kWallCorner + kWallU + kWallV,
                kWallCorner + kWallV, "wall_shader", wall) +
           node("distant_light", "sun", " direction 0.6 0.8 0\n color 3 2 1\n cast_shadows off");
}

LobeSums bounce_truth(const TestScene& scene) {
    return integrate_over_quad(scene.scene(), seen("plane"), kWallCorner, kWallU, kWallV, 300);
}

const Color kWallRadiance = Color(3, 2, 1) * (kSunCosine * kWallAlbedo * kInvPi);

}  // namespace

Verdict check_lobes_through_one_bounce() {
    const TestScene scene(
        bounce_scene(" GI_diffuse_depth 1\n GI_specular_depth 1\n GI_total_depth 1"),
        in_memory(with_suffix(kReflecting, "_indirect"),
                  {"by_wall_d C<RD><RD>L", "by_wall_s C<RS[^'coat']><RD>L"}));
    const Picture picture = render(scene);
    All all;
    all << compare(picture, bounce_truth(scene), kReflecting, "_indirect", kWallRadiance);
    all << check_equal(picture, "by_wall_d", picture, "diffuse_indirect")
        << check_equal(picture, "by_wall_s", picture, "specular_indirect");
    return all.verdict();
}

namespace {

/// rays  of each kind, squared: 1 is one ray that all lobes share, with more each kind has its own
Verdict check_depth_limits(bool diffuse_goes_on, int rays) {
    const std::string n = std::to_string(rays);
    const TestScene scene(
        bounce_scene((diffuse_goes_on ? " GI_diffuse_depth 1\n GI_specular_depth 0"
                                      : " GI_diffuse_depth 0\n GI_specular_depth 1") +
                     ("\n GI_diffuse_samples " + n) + "\n GI_specular_samples " + n),
        in_memory(with_suffix(kReflecting, "_indirect")));
    const Picture picture = render(scene);
    const LobeSums truth = bounce_truth(scene);
    const std::vector<std::string> diffuse{"diffuse"}, others{"specular", "coat", "sheen"};
    const std::vector<std::string>&bright = diffuse_goes_on ? diffuse : others,
          &dark = diffuse_goes_on ? others : diffuse;
    All all;
    all << compare(picture, truth, bright, "_indirect", kWallRadiance);
    for (const std::string& aov : dark)
        all << check_black(picture, aov + "_indirect");
    Color whole;
    for (const std::string& aov : bright)
        if (aov != "sheen") whole += truth.at(aov) * kWallRadiance;
    all << check_mean(picture, "RGBA", whole, kGridError);
    return all.verdict();
}

}  // namespace

Verdict check_depth_limits_by_lobe() {
    All all;
    for (const bool diffuse_goes_on : {false, true})
        for (const int rays : {1, 2})
            all << check_depth_limits(diffuse_goes_on, rays);
    return all.verdict();
}

Verdict check_masks_by_lobe() {
    All all;
    // Everything but diffuse_reflect (32), everything but specular_reflect (64).
    for (const int mask : {255 - 32, 255 - 64}) {
        const TestScene scene(
            bounce_scene(" GI_diffuse_depth 1\n GI_specular_depth 1\n GI_total_depth 1",
                         " visibility " + std::to_string(mask)),
            in_memory(with_suffix(kReflecting, "_indirect")));
        const Picture picture = render(scene);
        const bool diffuse = mask == 255 - 64;
        all << compare(picture, bounce_truth(scene),
                       diffuse ? std::vector<std::string>{"diffuse"}
                               : std::vector<std::string>{"specular", "coat", "sheen"},
                       "_indirect", kWallRadiance);
        for (const std::string& aov : diffuse
                                          ? std::vector<std::string>{"specular", "coat", "sheen"}
                                          : std::vector<std::string>{"diffuse"})
            all << check_black(picture, aov + "_indirect");
    }
    return all.verdict();
}

Verdict check_multipliers_by_lobe() {
    const Vec3f corner{-1.6F, 1.2F, -1.2F}, u{1.2F, 0, 0}, v{0, 0, 1.4F};
    const std::string light =
        node("quad_light", "key",
             " normalize off\n diffuse 0.25\n specular 0.75\n vertices 4 1 VECTOR " +
                 text_of(corner) + "  " + text_of(corner + u) + "  " + text_of(corner + u + v) +
                 "  " + text_of(corner + v));
    const TestScene scene(frame_text(20, 20, 7, point_camera()) + layered_shader() +
                              floor("plane", 0, 1, "layered") + light,
                          in_memory(with_suffix(kReflecting, "_direct")));
    const LobeSums truth = integrate_over_quad(scene.scene(), seen("plane"), corner, u, v, 300);
    const Picture picture = render(scene);
    All all;
    all << compare(picture, truth, {"diffuse"}, "_direct", Color::grey(0.25F))
        << compare(picture, truth, {"specular", "coat", "sheen"}, "_direct", Color::grey(0.75F));
    return all.verdict();
}

Verdict check_single_lobes() {
    struct OneLobe {
        const char* shader;
        const char* aov;
    };
    constexpr std::array kLobes{
        OneLobe{" specular 0", "diffuse"},
        OneLobe{" base 0\n specular_roughness 0.4", "specular"},
        OneLobe{" metalness 1\n specular_roughness 0.3", "specular"},
        OneLobe{" base 0\n specular 0\n coat 1\n coat_roughness 0.3", "coat"},
        OneLobe{" base 0\n specular 0\n sheen 1", "sheen"},
        OneLobe{" base 0\n specular 0\n thin_walled on\n transmission 1\n specular_roughness 0.5",
                "transmission"},
        OneLobe{" base 0\n specular 0\n transmission 1\n specular_roughness 0.5", "transmission"},
        OneLobe{" base 0\n specular 0\n thin_walled on\n subsurface 1", "sss"}};
    const std::vector<std::string> all_aovs{"diffuse", "specular",     "coat",
                                            "sheen",   "transmission", "sss"};
    All all;
    for (const OneLobe& lobe : kLobes) {
        const std::string own = lobe.aov;
        const Picture picture =
            render(frame_text(8, 8, 2, persp_camera({0, 3, 3}, {0, 0, 0}, 30)) +
                       node("standard_surface", "surface", lobe.shader) +
                       floor("plane", 0, 3, "surface") +
                       node("skydome_light", "sky", " intensity 0.5\n camera 0") +
                       node("quad_light", "key",
                            " intensity 9\n transmission 1\n vertices 4 1 VECTOR -1 2 -3  1 2 -3  "
                            "1 2 -1  -1 2 -1"),
                   in_memory(all_aovs));
        all << check_lit(picture, own) << check_equal(picture, "RGBA", picture, own);
        for (const std::string& aov : all_aovs)
            if (aov != own && !(own == "sheen" && aov == "specular"))
                all << check_black(picture, aov);
    }
    return all.verdict();
}

Verdict check_direct_light_is_direct() {
    // Emission is in the scene too, but where no ray can go: a wrong label would have an AOV to fall into.
    const Picture picture = render(
        frame_text(8, 8, 3, persp_camera({0, 3, 3}, {0, 0, 0}, 30)) + layered_shader() +
            floor("plane", 0, 3, "layered") + node("standard_surface", "glow", " emission 1") +
            sphere("lamp", {0, -5, 0}, 0.5F, "glow") +
            node("quad_light", "key",
                 " intensity 9\n vertices 4 1 VECTOR -1 2 -3  1 2 -3  1 2 -1  -1 2 -1"),
        in_memory({"direct", "indirect", "emission"}));
    All all;
    all << check_lit(picture, "direct") << check_equal(picture, "RGBA", picture, "direct")
        << check_black(picture, "indirect") << check_black(picture, "emission");
    return all.verdict();
}

Verdict check_additive_sets() {
    std::vector<std::string> aovs;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") aovs.emplace_back(b.name);
    const Picture picture =
        render(TestScene(scene_file("laws_lobes.ass"), in_memory(aovs), {"caustics"}));
    All all;
    for (const auto& set : lpe::additive_sets(lpe::BuiltinTable::Reference))
        all << check_sum(picture, "RGBA", {set.begin(), set.end()});
    return all.verdict();
}

Verdict check_path_log() {
    std::vector<std::string> aovs;
    for (const lpe::Builtin& b : lpe::builtins())
        if (b.name != "RGBA") aovs.emplace_back(b.name);
    RenderOptions options = in_memory(aovs);
    options.width = options.height = 16;
    options.spp = 1;
    const TestScene scene(scene_file("laws_lobes.ass"), options, {"caustics"});
    return check_oracle(scene.scene(), render(scene), log_paths(scene.scene()));
}

std::vector<NamedCheck> lobe_checks() {
    return {{"lobes under a quad", check_lobes_under_a_quad},
            {"lobes under a dome", check_lobes_under_a_dome},
            {"lobes on both sides", check_lobes_on_both_sides},
            {"lobes through one bounce", check_lobes_through_one_bounce},
            {"depth limits by lobe", check_depth_limits_by_lobe},
            {"masks by lobe", check_masks_by_lobe},
            {"multipliers by lobe", check_multipliers_by_lobe},
            {"single lobes", check_single_lobes},
            {"direct light is direct", check_direct_light_is_direct},
            {"additive sets", check_additive_sets},
            {"path log", check_path_log}};
}

}  // namespace lightsieve::testing

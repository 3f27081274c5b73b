// Scenes for tests: text in, a compiled scene or a picture in memory out.
//
// Tests write their scenes as they would stand in a file; `frame_text` gives the nodes that every scene needs, the other
// helpers write the few shapes that tests are made of. A scene that does not compile throws with all its errors, and so
// does one with warnings that a test did not ask for: a misspelt parameter must not make a test pass.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/vec.h"
#include "render/render.h"
#include "render/scene.h"
#include "scene/document.h"
#include "scene/graph.h"

namespace lightsieve::testing {

/// Options of a render in memory by one thread that asks for the layers `aovs` ("NAME" or "NAME TYPE") besides its own.
[[nodiscard]] RenderOptions in_memory(std::vector<std::string> aovs = {},
                                      std::vector<std::string> lpes = {});

/// Nodes `options`, a perspective camera `cam`, a box filter of one pixel `f` and a driver `d`, with the beauty as output.
///
/// options  more lines for the options node, wins over what stands there
[[nodiscard]] std::string frame_text(int width, int height, int aa_samples,
                                     std::string_view camera, std::string_view options = "");
/// The parameter `outputs` of the options node.
[[nodiscard]] std::string outputs(const std::vector<const char*>& strings);
/// A camera with parallel rays, `width` scene units wide.
[[nodiscard]] std::string ortho_camera(Vec3f eye, Vec3f target, float width, Vec3f up = {0, 1, 0});
[[nodiscard]] std::string persp_camera(Vec3f eye, Vec3f target, float fov_deg,
                                       Vec3f up = {0, 1, 0});
/// Parallel rays straight down onto the origin, a square `width` wide.
[[nodiscard]] std::string from_above(float width, float height = 2);
/// Rays toward the origin from the side, all to nearly the same point: each pixel is an estimate of the same radiance.
[[nodiscard]] std::string at_the_origin();
[[nodiscard]] std::string lambert(std::string_view name, float kd);
/// A horizontal quad light that shines downward.
[[nodiscard]] std::string square_light(std::string_view name, float y, float half_size,
                                       std::string_view more);
/// A quadrilateral whose outward side is that from which the corners run counter-clockwise; uv are those of a unit square.
[[nodiscard]] std::string quad(std::string_view name, Vec3f a, Vec3f b, Vec3f c, Vec3f d,
                               std::string_view shader, std::string_view more = "");
/// A horizontal square around the origin's vertical axis, facing up.
[[nodiscard]] std::string floor(std::string_view name, float y, float half_size,
                                std::string_view shader, std::string_view more = "");
[[nodiscard]] std::string sphere(std::string_view name, Vec3f center, float radius,
                                 std::string_view shader, std::string_view more = "");
/// Any node: `type { name NAME body }`.
[[nodiscard]] std::string node(std::string_view type, std::string_view name,
                               std::string_view body);
[[nodiscard]] std::string text_of(Vec3f v);
/// Numbers as a scene file has them, with all digits.
[[nodiscard]] std::string text_of(float v);

/// A compiled scene and all that it points to.
class TestScene {
  public:
    /// allowed_warnings  parts of messages that may be reported
    explicit TestScene(const std::string& text, const RenderOptions& options = in_memory(),
                       const std::vector<std::string>& allowed_warnings = {});
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }

  private:
    Diagnostics diagnostics_;
    std::unique_ptr<SceneGraph> graph_;
    ScenePtr scene_;
};

/// A rendered frame.
class Picture {
  public:
    explicit Picture(RenderResult result) : result_(std::move(result)) {}
    [[nodiscard]] int width() const { return result_.width; }
    [[nodiscard]] int height() const { return result_.height; }
    [[nodiscard]] std::size_t n_pixels() const {
        return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
    }
    [[nodiscard]] const RenderResult& result() const { return result_; }
    [[nodiscard]] bool has(std::string_view layer) const;
    /// By the layer's name; throws if there is none.
    [[nodiscard]] const FrameLayer& layer(std::string_view name) const;
    /// Colour of a pixel; layers of one channel give grey.
    [[nodiscard]] Color color(std::string_view layer, std::size_t pixel) const;
    [[nodiscard]] float alpha(std::string_view layer, std::size_t pixel) const;
    [[nodiscard]] Color mean(std::string_view layer) const;
    [[nodiscard]] double mean_alpha(std::string_view layer) const;

  private:
    RenderResult result_;
};

[[nodiscard]] Picture render(const TestScene& scene);
[[nodiscard]] Picture render(const std::string& text, const RenderOptions& options = in_memory());
/// A scene of tests/scenes.
[[nodiscard]] std::string scene_file(std::string_view name);

}  // namespace lightsieve::testing

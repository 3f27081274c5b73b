#include "render/testing/test_scene.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "nodes/all_nodes.h"
#include "scene/ass_read.h"

namespace lightsieve::testing {
namespace {

/// "NAME" to "NAME TYPE": colours unless the name is one of the few data layers.
std::string with_type(std::string aov) {
    return aov.find(' ') == std::string::npos ? aov + " RGB" : aov;
}

bool allowed(const Error& item, const std::vector<std::string>& warnings) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) {
        return item.message.find(w) != std::string::npos;
    });
}

}  // namespace

RenderOptions in_memory(std::vector<std::string> aovs, std::vector<std::string> lpes) {
    RenderOptions options;
    options.threads = 1;
    options.capture = true;
    options.write_files = false;
    for (std::string& aov : aovs)
        options.aovs.push_back(with_type(std::move(aov)));
    options.lpes = std::move(lpes);
    return options;
}

std::string text_of(float v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(v));
    return text;
}
std::string text_of(Vec3f v) { return text_of(v.x) + ' ' + text_of(v.y) + ' ' + text_of(v.z); }

std::string node(std::string_view type, std::string_view name, std::string_view body) {
    std::string out(type);
    out += "\n{\n name ";
    out += name;
    out += '\n';
    out += body;
    return out + "\n}\n";
}

std::string frame_text(int width, int height, int aa_samples, std::string_view camera,
                       std::string_view options) {
    std::string out = "options\n{\n";
    const auto line = [&](std::string_view param, const std::string& value) {
        // What the caller writes wins: a parameter may stand only once.
        if (options.find(std::string(param) + ' ') == std::string_view::npos)
            out += ' ' + std::string(param) + ' ' + value + '\n';
    };
    line("xres", std::to_string(width));
    line("yres", std::to_string(height));
    line("AA_samples", std::to_string(aa_samples));
    line("camera", "cam");
    line("outputs", "\"RGBA RGBA f d\"");
    out += options;
    out += "\n}\n";
    out += node("box_filter", "f", " width 1") + node("driver_exr", "d", " filename \"test.exr\"");
    out += camera;
    return out;
}

std::string outputs(const std::vector<const char*>& strings) {
    std::string out = " outputs " + std::to_string(strings.size()) + " 1 STRING";
    for (const char* s : strings)
        out += std::string(" \"") + s + '"';
    return out + '\n';
}

std::string ortho_camera(Vec3f eye, Vec3f target, float width, Vec3f up) {
    const std::string half = text_of(width / 2);
    return node("ortho_camera", "cam",
                " position " + text_of(eye) + "\n look_at " + text_of(target) + "\n up " +
                    text_of(up) + "\n screen_window_min -" + half + " -" + half +
                    "\n screen_window_max " + half + ' ' + half);
}

std::string persp_camera(Vec3f eye, Vec3f target, float fov_deg, Vec3f up) {
    return node("persp_camera", "cam",
                " position " + text_of(eye) + "\n look_at " + text_of(target) + "\n up " +
                    text_of(up) + "\n fov " + text_of(fov_deg));
}

std::string from_above(float width, float height) {
    return ortho_camera({0, height, 0}, {0, 0, 0}, width, {0, 0, -1});
}

std::string at_the_origin() { return ortho_camera({0.7F, 0.5F, 0.4F}, {0, 0, 0}, 1e-3F); }

std::string lambert(std::string_view name, float kd) {
    return node("lambert", name, " Kd " + text_of(kd));
}

std::string square_light(std::string_view name, float y, float half_size, std::string_view more) {
    const float h = half_size;
    const std::string corners = text_of(Vec3f{-h, y, -h}) + "  " + text_of(Vec3f{h, y, -h}) +
                                "  " + text_of(Vec3f{h, y, h}) + "  " + text_of(Vec3f{-h, y, h});
    return node("quad_light", name, " vertices 4 1 VECTOR " + corners + '\n' + std::string(more));
}

std::string quad(std::string_view name, Vec3f a, Vec3f b, Vec3f c, Vec3f d,
                 std::string_view shader, std::string_view more) {
    return node("polymesh", name,
                " nsides 1 1 UINT 4\n vidxs 4 1 UINT 0 1 2 3\n uvlist 4 1 VECTOR2 0 0 1 0 1 1 0 "
                "1\n vlist 4 1 VECTOR " +
                    text_of(a) + "  " + text_of(b) + "  " + text_of(c) + "  " + text_of(d) +
                    "\n shader " + std::string(shader) + '\n' + std::string(more));
}

std::string floor(std::string_view name, float y, float half_size, std::string_view shader,
                  std::string_view more) {
    const float h = half_size;
    return quad(name, {-h, y, -h}, {-h, y, h}, {h, y, h}, {h, y, -h}, shader, more);
}

std::string sphere(std::string_view name, Vec3f center, float radius, std::string_view shader,
                   std::string_view more) {
    return node("sphere", name,
                " center " + text_of(center) + "\n radius " + text_of(radius) + "\n shader " +
                    std::string(shader) + '\n' + std::string(more));
}

TestScene::TestScene(const std::string& text, const RenderOptions& options,
                     const std::vector<std::string>& allowed_warnings) {
    const Document document = read_ass(text, "test.ass", {}, diagnostics_);
    graph_ =
        std::make_unique<SceneGraph>(build_graph(document, builtin_registry(), {}, diagnostics_));
    scene_ = compile_scene(*graph_, options, diagnostics_);
    for (const Error& item : diagnostics_.items())
        if (item.severity == Severity::Warning && !allowed(item, allowed_warnings))
            throw std::runtime_error("a test's scene has warnings:\n" + diagnostics_.render());
    if (!scene_)
        throw std::runtime_error("a test's scene does not compile:\n" + diagnostics_.render());
}

bool Picture::has(std::string_view name) const {
    return std::any_of(result_.layers.begin(), result_.layers.end(),
                       [&](const FrameLayer& l) { return l.info.name == name; });
}

const FrameLayer& Picture::layer(std::string_view name) const {
    for (const FrameLayer& l : result_.layers)
        if (l.info.name == name) return l;
    std::string known;
    for (const FrameLayer& l : result_.layers)
        known += ' ' + l.info.name;
    throw std::runtime_error("the picture has no layer \"" + std::string(name) + "\", but" +
                             known);
}

Color Picture::color(std::string_view name, std::size_t pixel) const {
    const FrameLayer& l = layer(name);
    const float* p = &l.pixels.at(pixel * l.info.n_channels);
    return l.info.n_channels >= 3 ? Color{p[0], p[1], p[2]} : Color::grey(p[0]);
}

float Picture::alpha(std::string_view name, std::size_t pixel) const {
    const FrameLayer& l = layer(name);
    if (l.info.n_channels != 4) throw std::runtime_error("layer " + l.info.name + " has no alpha");
    return l.pixels.at(pixel * 4 + 3);
}

Color Picture::mean(std::string_view name) const {
    double sum[3] = {};
    for (std::size_t i = 0; i < n_pixels(); ++i)
        for (int c = 0; c < 3; ++c)
            sum[c] += static_cast<double>(color(name, i)[c]);
    const double n = static_cast<double>(n_pixels());
    return {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n),
            static_cast<float>(sum[2] / n)};
}

double Picture::mean_alpha(std::string_view name) const {
    double sum = 0;
    for (std::size_t i = 0; i < n_pixels(); ++i)
        sum += static_cast<double>(alpha(name, i));
    return sum / static_cast<double>(n_pixels());
}

Picture render(const TestScene& scene) {
    Diagnostics diagnostics;
    Picture picture(render_scene(scene.scene(), {}, diagnostics));
    if (!diagnostics.items().empty())
        throw std::runtime_error("a test's render complains:\n" + diagnostics.render());
    return picture;
}

Picture render(const std::string& text, const RenderOptions& options) {
    return render(TestScene(text, options));
}

std::string scene_file(std::string_view name) {
    const std::string path =
        std::string(LIGHTSIEVE_SOURCE_DIR) + "/tests/scenes/" + std::string(name);
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    if (!in) throw std::runtime_error("cannot read " + path);
    return text.str();
}

}  // namespace lightsieve::testing

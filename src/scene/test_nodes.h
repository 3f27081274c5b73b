// A small registry for tests of this folder: node types with every kind of parameter, and nothing that renders.
//
// The names are Arnold's so that test files look like real ones; the real nodes live in src/nodes.
#pragma once

#include "scene/camera.h"
#include "scene/describe.h"
#include "scene/light.h"
#include "scene/registry.h"
#include "scene/shade_point.h"

namespace lightsieve::test {

struct Options {
    std::int32_t AA_samples = 1;
    Array<Name> outputs;
    NodeRef camera;
    NodeRef operator_node;
    Color background{0, 0, 0};
    bool enable = false;
    static NodeType describe() {
        Describe<Options> d("options", NodeKind::Options, "test");
        d.param("AA_samples", &Options::AA_samples, "test");
        d.param("outputs", &Options::outputs, "test");
        d.param("camera", &Options::camera, "test");
        d.param("operator", &Options::operator_node, "test");
        d.param("background", &Options::background, "test");
        d.param("enable_assignment", &Options::enable, "test");
        return d.done();
    }
};

enum class Handedness : std::int32_t { Right, Left };

struct Camera {
    float fov = 60;
    Array<Mat4f> matrix;
    Vec2f screen_window_min{-1, -1};
    Handedness handedness = Handedness::Right;
    Array<NodeRef> filters;
    float exposure = 0;
    static NodeType describe() {
        Describe<Camera> d("persp_camera", NodeKind::Camera, "test");
        d.param("fov", &Camera::fov, "test").hard_range(0.1F, 179);
        d.param("matrix", &Camera::matrix, "test");
        d.param("screen_window_min", &Camera::screen_window_min, "test");
        d.param("handedness", &Camera::handedness, "test").names({"right", "left"});
        d.param("filters", &Camera::filters, "test");
        d.param("exposure", &Camera::exposure, "test").pending();
        return d.done();
    }
};

struct Mesh {
    Array<std::uint32_t> nsides, vidxs, nidxs, uvidxs;
    Array<Vec3f> vlist, nlist;
    Array<Vec2f> uvlist;
    Array<std::uint8_t> shidxs;
    Array<Mat4f> matrix;
    Array<NodeRef> shader, light_group;
    std::uint8_t visibility = 255;
    std::uint32_t id = 0;
    NodeRef disp_map;
    bool smoothing = false;
    Array<Name> trace_sets;
    static NodeType describe() {
        Describe<Mesh> d("polymesh", NodeKind::Shape, "test");
        d.param("nsides", &Mesh::nsides, "test");
        d.param("vidxs", &Mesh::vidxs, "test");
        d.param("nidxs", &Mesh::nidxs, "test");
        d.param("uvidxs", &Mesh::uvidxs, "test");
        d.param("vlist", &Mesh::vlist, "test");
        d.param("nlist", &Mesh::nlist, "test");
        d.param("uvlist", &Mesh::uvlist, "test");
        d.param("shidxs", &Mesh::shidxs, "test");
        d.param("matrix", &Mesh::matrix, "test");
        d.param("shader", &Mesh::shader, "test");
        d.param("light_group", &Mesh::light_group, "test");
        d.param("visibility", &Mesh::visibility, "test");
        d.param("id", &Mesh::id, "test");
        d.param("disp_map", &Mesh::disp_map, "test");
        d.param("smoothing", &Mesh::smoothing, "test");
        d.param("trace_sets", &Mesh::trace_sets, "test");
        return d.done();
    }
};

struct Instance {
    NodeRef node;
    static NodeType describe() {
        Describe<Instance> d("ginstance", NodeKind::Shape, "test");
        d.param("node", &Instance::node, "test");
        return d.done();
    }
};

struct Light {
    Color color{1, 1, 1};
    NodeRef mesh;
    std::int32_t samples = 1, volume_samples = 2;
    static NodeType describe() {
        Describe<Light> d("mesh_light", NodeKind::Light, "test");
        d.param("color", &Light::color, "test");
        d.param("mesh", &Light::mesh, "test");
        d.param("samples", &Light::samples, "test").hard_range(0, 100);
        d.param("volume_samples", &Light::volume_samples, "test").ignored();
        return d.done();
    }
};

struct Driver {
    Name filename;
    Name color_space{"auto"};
    bool half = false;
    static NodeType describe() {
        Describe<Driver> d("driver_tiff", NodeKind::Driver, "test");
        d.param("filename", &Driver::filename, "test");
        d.param("color_space", &Driver::color_space, "test");
        d.param("half_precision", &Driver::half, "test");
        return d.done();
    }
};

/// A closure shader.
struct Surface {
    float base = 1;
    Color base_color{0.8F, 0.8F, 0.8F};
    Color emission_color{1, 1, 1};
    Vec3f normal;
    float coat = 0;
    static NodeType describe() {
        Describe<Surface> d("standard_surface", NodeKind::Shader, "test");
        d.param("base", &Surface::base, "test").range(0, 1);
        d.param("base_color", &Surface::base_color, "test");
        d.param("emission_color", &Surface::emission_color, "test");
        d.param("normal", &Surface::normal, "test");
        d.param("coat", &Surface::coat, "test").hard_range(0, 1);
        return d.done();
    }
    void eval(const ShadePoint&, ClosureSet&) const {}
};

struct Mix {
    ShaderRef shader1, shader2;
    float mix = 0.5F;
    static NodeType describe() {
        Describe<Mix> d("mix_shader", NodeKind::Shader, "test");
        d.param("shader1", &Mix::shader1, "test");
        d.param("shader2", &Mix::shader2, "test");
        d.param("mix", &Mix::mix, "test");
        return d.done();
    }
    void eval(const ShadePoint&, ClosureSet&) const {}
};

struct Checker {
    Color color1{1, 1, 1}, color2{0, 0, 0};
    float u_frequency = 1;
    static NodeType describe() {
        Describe<Checker> d("checkerboard", NodeKind::Shader, "test");
        d.param("color1", &Checker::color1, "test");
        d.param("color2", &Checker::color2, "test");
        d.param("u_frequency", &Checker::u_frequency, "test");
        return d.done();
    }
    Color eval(const ShadePoint&) const { return color1; }
};

enum class Interpolation : std::int32_t { Constant, Linear, CatmullRom, Monotone };

struct Ramp {
    Color input;
    Array<float> position;
    Array<Color> color;
    Array<Interpolation> interpolation;
    Rgba extra{{0, 0, 0}, 1};
    Mat4f placement;
    Name uvset;
    static NodeType describe() {
        Describe<Ramp> d("ramp_rgb", NodeKind::Shader, "test");
        d.param("input", &Ramp::input, "test");
        d.param("position", &Ramp::position, "test");
        d.param("color", &Ramp::color, "test");
        d.param("interpolation", &Ramp::interpolation, "test")
            .names({"constant", "linear", "catmull-rom", "monotonecubic"});
        d.param("extra", &Ramp::extra, "test");
        d.param("placement", &Ramp::placement, "test");
        d.param("uvset", &Ramp::uvset, "test");
        return d.done();
    }
    Rgba eval(const ShadePoint&) const { return extra; }
};

inline const Registry& registry() {
    static const Registry all = [] {
        Registry out;
        out.add(Options::describe());
        out.add(Camera::describe());
        out.add(Mesh::describe());
        out.add(Instance::describe());
        out.add(Light::describe());
        out.add(Driver::describe());
        out.add(Surface::describe());
        out.add(Mix::describe());
        out.add(Checker::describe());
        out.add(Ramp::describe());
        return out;
    }();
    return all;
}

}  // namespace lightsieve::test

// How a graph becomes a Scene; private to compile*.cpp.
//
// Order: settings and cameras, shaders and shapes, lights, events, outputs and expressions, acceleration structures.
// Each step reports all that is wrong with it; the scene is handed out only if nothing was.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "render/assets.h"
#include "render/motion.h"
#include "render/render.h"
#include "render/scene.h"
#include "render/shape_leaf.h"
#include "scene/graph.h"
#include "scene/imager.h"
#include "scene/light_filter.h"
#include "scene/node_context.h"

namespace lightsieve {

class Compiler {
  public:
    Compiler(const SceneGraph& graph, const RenderOptions& options, Diagnostics& diagnostics);
    [[nodiscard]] ScenePtr run();

    // For the node context.
    [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
    [[nodiscard]] TextureCache& textures() { return *scene_->textures; }
    [[nodiscard]] const ColorSpaces& color_spaces() const { return *scene_->color_spaces; }
    [[nodiscard]] const std::string& wanted_rendering_space() const {
        return options_.rendering_space;
    }
    [[nodiscard]] const AssetFinder& assets() const { return assets_; }
    [[nodiscard]] const RenderSettings& settings() const { return scene_->settings; }
    [[nodiscard]] bool ignore_missing_textures() const { return ignore_missing_textures_; }
    /// The program of a shader node whose events carry these labels; null if it cannot be made (an error was reported).
    [[nodiscard]] const ShaderProgram* program_for(const NodeInstance& node,
                                                   const EventLabels& labels = {}, int depth = 0);
    /// The camera that the frame is about; null with an error reported if there is none.
    const NodeInstance* default_camera();
    [[nodiscard]] const SceneGraph& graph() const { return graph_; }
    void keep(std::shared_ptr<const void> data) { scene_->kept.push_back(std::move(data)); }
    [[nodiscard]] float frame_number() const;
    [[nodiscard]] std::uint32_t written_aov(Name aov);
    [[nodiscard]] std::uint32_t add_matte(const NodeInstance* by, const Matte& matte);
    void for_each_shape(const std::function<void(const PlacedShape&)>& body) const;
    /// A colour parameter of a node that is no shader, with its links.
    [[nodiscard]] ColorInput linked_color(const NodeInstance& node, const ParamInfo& param);
    /// Geometry of a shape that is not an instance; null with an error reported.
    [[nodiscard]] std::unique_ptr<ShapeGeometry> geometry_of(const NodeInstance& node);

  private:
    // compile_color.cpp
    void make_color_spaces();
    [[nodiscard]] std::shared_ptr<const ColorSpaces> configured_color_spaces();

    // compile.cpp
    void read_settings();
    void read_region();
    void read_adaptive();
    /// The layer that options.adaptive_aov names.
    void find_adaptive_layer();
    void check_motion();
    void find_culling();
    void make_cameras();
    void finish_depth_rules();
    void summarize_scene();
    void note_times(double seconds);
    void read_log_settings();
    /// What a checkpoint must agree with, and where it lies (compile_identity.cpp).
    void identify();
    [[nodiscard]] bool has_caustics() const;
    template <class T>
    [[nodiscard]] T option(Name param, T fallback) const {
        return graph_.options() == nullptr ? fallback : graph_.options()->get<T>(param);
    }
    [[nodiscard]] SourceSpan option_place(Name param) const;

    // compile_shaders.cpp
    void link_parameters(const NodeInstance& node, ShaderProgram& program, int depth);
    void link_closures(const NodeInstance& node, ShaderProgram& program, int depth);
    [[nodiscard]] bool shader_may_be_transparent(const NodeInstance& node) const;
    [[nodiscard]] static bool shader_may_tint_shadows(const NodeInstance& node);
    [[nodiscard]] static bool shader_may_scatter_inside(const NodeInstance& node);
    [[nodiscard]] static bool shader_may_disperse(const NodeInstance& node);
    const ShaderProgram* default_shader(const std::string& object_label);
    void make_background();
    void make_atmosphere();

    // compile_mattes.cpp
    void make_aov_shaders();
    void find_coordinate_readers();
    [[nodiscard]] bool wants_default_mattes() const;

    // compile_shapes.cpp
    void make_shapes();
    [[nodiscard]] const ShapeGeometry* shared_geometry(const NodeInstance& node);
    void resample_motion(ShapeGeometry& geometry, MotionRange range) const;

    // compile_instances.cpp
    /// Gives `sink` all shapes that the node places, in the space that the node lies in.
    void find_leaves(const NodeInstance& node, const LeafUse& use, const LeafSink& sink);
    void leaves_of(const NodeInstance& node, const LeafUse& use, const LeafSink& sink);
    void leaves_of_instance(const NodeInstance& node, const ShapeGeometry& geometry,
                            const LeafUse& use, const LeafSink& sink);
    void leaves_of_procedural(const NodeInstance& node, const NodeScope& inside,
                              const LeafUse& use, const LeafSink& sink);
    void leaves_of_instancer(const NodeInstance& node, const ShapeGeometry& geometry,
                             const LeafUse& use, const LeafSink& sink);
    [[nodiscard]] std::vector<ShapeLeaf> leaves_for_instances(const NodeInstance& node,
                                                              const NodeRef& ref, std::uint32_t n,
                                                              const LeafUse& use);
    [[nodiscard]] const NodeInstance* placed_shape(const NodeInstance& by, const NodeRef& ref,
                                                   const char* param);
    /// A lineage with one more step, kept by the scene. lineage: null for the shape itself.
    [[nodiscard]] const Lineage* extend(const Lineage* lineage, const NodeInstance& node,
                                        std::uint32_t n_instances);
    /// A shape that a node places, and how often.
    struct PlacedSource {
        const NodeInstance* node = nullptr;
        std::uint64_t times = 0;
    };
    std::vector<PlacedSource> sources_of(const NodeInstance& node);
    bool is_leaf(const NodeInstance& node);
    std::uint64_t count_leaves(const NodeInstance& node);
    void place_all(const NodeInstance& node);

    // compile_objects.cpp
    void place(ShapeLeaf&& leaf);
    [[nodiscard]] bool set_placement(const ShapeLeaf& leaf, SceneObject& object);
    [[nodiscard]] const ShaderList& shaders_of(const ShapeLeaf& leaf);
    [[nodiscard]] Name object_label_of(const NodeInstance& node);
    void add_surface_shader(const ShaderProgram* program);
    [[nodiscard]] std::vector<std::uint32_t> light_indices(const Array<NodeRef>& group) const;
    [[nodiscard]] const LightSampler* lights_of(const Array<NodeRef>& group);
    [[nodiscard]] const std::vector<bool>* shadow_lights_of(const Array<NodeRef>& group);
    /// If the shape holds a volume, makes it one.
    bool add_volume(const ShapeLeaf& leaf, const SceneObject& object);
    void check_channels(const NodeInstance& node, const SceneVolume& volume);

    // compile_displacement.cpp
    /// Moves the vertices of a mesh whose node has a disp_map.
    void displace(const NodeInstance& node, ShapeGeometry& geometry);
    [[nodiscard]] const ShaderProgram* displacement_program(const NodeInstance& node,
                                                            const NodeRef& ref);

    // compile_lights.cpp
    void make_lights();
    void set_portals(const NodeInstance& last);
    void read_shutter();
    [[nodiscard]] std::uint64_t count_lights(const NodeScope& scope);
    void make_lights_of(const NodeScope& scope, const Mat4f& outer, const NodeInstance*& portal);
    void add_light(const NodeInstance& node, std::unique_ptr<Light> light, const Mat4f& place);
    [[nodiscard]] std::vector<Mat4f> light_stops(const NodeInstance& node);
    /// The lights of the scene that a node of the file stands for: several if it moves, or where procedurals share it.
    [[nodiscard]] std::vector<std::uint32_t> indices_of_light(NodeRef light) const;
    void add_filters(const NodeInstance& node, const Mat4f& place, SceneLight& light);
    [[nodiscard]] static LightPlace light_place(const NodeInstance& node, const Mat4f& place);
    void add_light_geometry();

    // compile_events.cpp
    void gather_events();
    std::uint32_t event_index(const Event& event);
    void fill_records();

    // compile_outputs.cpp
    void make_views();
    void part_passes();
    void make_drivers();
    void make_driver(PlannedDriver& planned, std::size_t index);
    [[nodiscard]] Imagers make_imagers(const NodeInstance* last);
    void attach_imagers(PlannedDriver& planned);
    void check_files();
    void check_deep(PlannedDriver& planned);
    /// The layers that a viewer is to show.
    void find_viewer_layers();

    // compile_accel.cpp
    void make_accels();
    void finish_volumes();
    void find_mask_types();

    const SceneGraph& graph_;
    const RenderOptions& options_;
    Diagnostics& diagnostics_;
    ScenePtr scene_;
    AssetFinder assets_;
    bool ignore_missing_textures_ = false, abort_on_error_ = true;
    std::map<std::pair<const NodeInstance*, EventLabels>, ShaderProgram*>
        programs_;  ///< null: the default shader
    std::map<const NodeInstance*, const ShaderProgram*>
        prepared_;  ///< the first program of each node
    std::set<const NodeInstance*> failed_shaders_;
    std::map<const NodeInstance*, const ShapeGeometry*> geometry_by_node_;
    std::map<const NodeInstance*, std::vector<std::uint32_t>> lights_of_node_;
    std::map<const NodeInstance*, const DisplacementMap*> bumps_;  ///< of displaced meshes
    std::map<std::vector<std::uint32_t>, const LightSampler*> samplers_by_group_;
    std::map<std::vector<std::uint32_t>, const std::vector<bool>*> shadow_lights_by_group_;
    /// By shader or list of shaders, their number, and object label.
    std::map<std::tuple<const void*, std::uint32_t, const void*>, ShaderList*> shader_lists_;
    std::uint64_t n_leaves_ = 0;                              ///< placed so far
    std::map<const NodeScope*, std::uint64_t> light_counts_;  ///< with those of procedurals within
    std::map<const NodeInstance*, std::uint64_t> leaf_counts_;  ///< by node
    std::vector<const NodeInstance*> open_shapes_;              ///< whose leaves are being found
    std::set<ShaderProgram*> surface_shaders_;  ///< shaders that shapes use: these make events
    std::map<Event, std::uint32_t> event_index_;
    std::vector<Name> written_aovs_;  ///< AOVs that shaders write, by number
    bool shapes_are_known_ = false;   ///< all of them are placed
};

/// What a node may ask of the compiler.
class CompileContext final : public NodeContext {
  public:
    CompileContext(Compiler& compiler, const NodeInstance* node, Name name)
        : compiler_(compiler), node_(node), name_(name) {}
    Diagnostics& diagnostics() override { return compiler_.diagnostics(); }
    SourceSpan where(Name param) const override {
        return node_ == nullptr ? SourceSpan{} : node_->where(param);
    }
    Name node_name() const override { return name_; }
    ColorInput color_input(Name param) override;
    bool is_linked(Name param) const override {
        return node_ != nullptr && node_->is_linked(param);
    }
    std::vector<Name> user_texts(Name attribute) override;
    std::vector<Name> possible_texts(Name param) override;
    void keep(std::shared_ptr<const void> data) override { compiler_.keep(std::move(data)); }
    float frame_number() const override { return compiler_.frame_number(); }
    std::uint32_t written_aov(Name aov) override { return compiler_.written_aov(aov); }
    std::uint32_t add_matte(const Matte& matte) override {
        return compiler_.add_matte(node_, matte);
    }
    void for_each_shape(const std::function<void(const PlacedShape&)>& body) override {
        compiler_.for_each_shape(body);
    }
    const NodeInstance* camera() override { return compiler_.default_camera(); }
    TextureCache& textures() override { return compiler_.textures(); }
    const ColorSpaces& color_spaces() const override { return compiler_.color_spaces(); }
    std::string wanted_rendering_space() const override {
        return compiler_.wanted_rendering_space();
    }
    std::optional<std::string> find_asset(std::string_view filename) const override {
        return compiler_.assets().find(filename);
    }
    bool ignore_missing_textures() const override { return compiler_.ignore_missing_textures(); }
    Frame frame() const override;
    std::unique_ptr<ShapeGeometry> geometry_of(NodeRef shape, Mat4f& world_from_object) override;
    /// The node lies in procedurals with this matrix, and so does what it names.
    void set_outer(const Mat4f& outer) { outer_ = outer; }

  private:
    Mat4f outer_;
    Compiler& compiler_;
    const NodeInstance* node_;
    Name name_;
};

}  // namespace lightsieve

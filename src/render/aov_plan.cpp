#include "render/aov_plan.h"

#include <algorithm>
#include <array>
#include <set>

#include "lpe/builtins.h"
#include "lpe/lint.h"
#include "lpe/parse.h"
#include "lpe/regions.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

struct DataAov {
    std::string_view name;
    LayerSource source;
    std::array<std::string_view, 3> types;  ///< the first is the natural one
};

/// AOVs that are no light path expressions, with the types that they can be written as.
constexpr std::array<DataAov, 18> kDataAovs{{
    {"Z", LayerSource::Depth, {"FLOAT", "", ""}},
    {"N", LayerSource::Normal, {"VECTOR", "RGB", ""}},
    {"P", LayerSource::Position, {"VECTOR", "RGB", ""}},
    {"A", LayerSource::Alpha, {"FLOAT", "", ""}},
    {"opacity", LayerSource::Opacity, {"RGB", "FLOAT", ""}},
    {"volume_opacity", LayerSource::VolumeOpacity, {"RGB", "FLOAT", ""}},
    {"ID", LayerSource::Id, {"UINT", "INT", ""}},
    {"uv", LayerSource::Uv, {"VECTOR2", "RGB", "VECTOR"}},
    {"shadow", LayerSource::Shadow, {"RGB", "FLOAT", ""}},
    {"shadow_diff", LayerSource::ShadowDifference, {"RGB", "FLOAT", ""}},
    {"shadow_mask", LayerSource::ShadowMask, {"RGB", "FLOAT", ""}},
    {"Pref", LayerSource::Pref, {"VECTOR", "RGB", ""}},
    {"motionvector", LayerSource::Motion, {"RGB", "VECTOR", "VECTOR2"}},
    {"raycount", LayerSource::RayCount, {"FLOAT", "", ""}},
    {"cputime", LayerSource::CpuTime, {"FLOAT", "", ""}},
    {"AA_inv_density", LayerSource::InverseDensity, {"FLOAT", "", ""}},
    {"clamp_loss", LayerSource::ClampLoss, {"RGB", "FLOAT", ""}},
    {"unclamped", LayerSource::Unclamped, {"RGB", "FLOAT", ""}},
}};

constexpr std::array<std::string_view, 8> kTypes{"RGB",  "RGBA", "FLOAT",  "INT",
                                                 "UINT", "BOOL", "VECTOR", "VECTOR2"};

std::vector<std::string> split_blanks(std::string_view text) {
    std::vector<std::string> out;
    constexpr std::string_view kBlank = " \t\r\n";
    for (std::size_t at = text.find_first_not_of(kBlank); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
        out.emplace_back(text.substr(at, end - at));
        at = text.find_first_not_of(kBlank, end);
    }
    return out;
}

/// The place of one quoted string inside the place of an array, or the array's place if it cannot be found.
SourceSpan element_place(const SourceSpan& array, std::string_view element,
                         std::size_t& search_from) {
    const std::string_view all = array.text();
    const std::string quoted = '"' + std::string(element) + '"';
    const std::size_t at = all.find(quoted, search_from);
    if (at == std::string_view::npos) return array;
    search_from = at + quoted.size();
    return {array.source, array.offset + at + 1, element.size()};
}

/// The strings of an options array, each with its place.
std::vector<std::pair<std::string, SourceSpan>> option_strings(const SceneGraph& graph,
                                                               Name param) {
    std::vector<std::pair<std::string, SourceSpan>> out;
    if (graph.options() == nullptr) return out;
    const SourceSpan where = graph.options()->where(param);
    std::size_t from = 0;
    for (Name text : graph.options()->get<Array<Name>>(param).first_key())
        out.emplace_back(text.str(), element_place(where, text.view(), from));
    return out;
}

std::vector<std::string> names_of_kind(const SceneGraph& graph, NodeKind kind) {
    std::vector<std::string> out;
    for (const auto& node : graph.nodes())
        if (node->kind() == kind && node->is_named()) out.push_back(node->name().str());
    return out;
}

std::string listed(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names)
        out += (out.empty() ? "\"" : ", \"") + name + '"';
    return out;
}

/// The layer of a matte that holds its ids number 2 * index and 2 * index + 1.
std::string matte_layer(const std::string& matte, int index) {
    return matte + (index < 10 ? "0" : "") + std::to_string(index);
}

class Planner {
  public:
    Planner(const PlanInput& input, AovPlan& plan, Diagnostics& diagnostics)
        : input_(input), plan_(plan), diagnostics_(diagnostics), table_(choose_table()) {}

    void run() {
        plan_.table = table_.table();
        plan_.written.assign(input_.written.begin(), input_.written.end());
        plan_.light_groups.assign(input_.light_groups.begin(), input_.light_groups.end());
        define_expressions();
        plan_.custom = table_.custom();
        gather_outputs();
        resolve();
        compile();
    }

  private:
    lpe::BuiltinTable choose_table() {
        std::string name = input_.options.lpe_table;
        SourceSpan where;
        if (const NodeInstance* options = input_.graph.options();
            name.empty() && options != nullptr) {
            const UserData* data = options->find_user_data("lpe_table");
            if (data != nullptr && data->type == ParamType::String && data->n > 0) {
                name = data->values<Name>()[0].str();
                where = data->where;
            }
        }
        if (name.empty() || name == "reference") return lpe::BuiltinTable::Reference;
        if (name == "arnold7") return lpe::BuiltinTable::Arnold7;
        diagnostics_.error(Code::OutputBad,
                           "no table of built-in expressions is called \"" + name + '"', where,
                           "\"reference\" and \"arnold7\" are");
        return lpe::BuiltinTable::Reference;
    }

    void define_expressions() {
        if (input_.options.lpe_standard) table_.require_standard();
        for (const auto& [text, where] : option_strings(input_.graph, "light_path_expressions"))
            table_.define(text, where, diagnostics_);
        for (const std::string& text : input_.options.lpes)
            table_.define(text, lpe::stand_alone(text, "<--lpe>"), diagnostics_);
        table_.resolve(diagnostics_);
    }

    void gather_outputs() {
        for (const auto& [text, where] : option_strings(input_.graph, "outputs"))
            if (std::optional<OutputString> output = parse_output(text, where, diagnostics_))
                outputs_.push_back(std::move(*output));
        const OutputString first = first_for_more();
        const bool asks_more = !input_.options.aovs.empty() || !input_.options.lpes.empty();
        const bool nothing_written = outputs_.empty() && !diagnostics_.has_errors();
        // A scene that asks for nothing gets its beauty, and so does one that only the command line asks something of.
        if (nothing_written) outputs_.push_back({"", "RGBA", "RGBA", "", "", "", false, {}});
        if (!asks_more) return;
        for (const std::string& text : input_.options.aovs) {
            const std::vector<std::string> words = split_blanks(text);
            const SourceSpan where = lpe::stand_alone(text, "<--aov>");
            if (words.empty() || words.size() > 2) {
                diagnostics_.error(Code::OutputBad, "\"" + text + "\" is no AOV name and type",
                                   where, "for example \"diffuse RGB\" or \"N VECTOR\"");
                continue;
            }
            const std::string type = words.size() > 1 ? words[1] : natural_type(words[0]);
            if (!is_written(words[0], type, first.driver))
                outputs_.push_back(
                    {"", words[0], type, first.filter, first.driver, "", false, where});
        }
        for (const std::string& text : input_.options.lpes)
            if (const std::vector<std::string> words = split_blanks(text); !words.empty())
                outputs_.push_back({"", words[0], "RGB", first.filter, first.driver, "", false,
                                    lpe::stand_alone(text, "<--lpe>")});
    }

    /// The output whose driver and filter those of the command line take: the first to a file that holds many.
    [[nodiscard]] OutputString first_for_more() const {
        for (const OutputString& output : outputs_) {
            const NodeInstance* driver = input_.graph.find(output.driver);
            if (driver != nullptr && driver->type().name == Name("driver_exr")) return output;
        }
        return outputs_.empty() ? OutputString{} : outputs_.front();
    }

    /// Whether a driver gets that layer already; with alpha it is there, too.
    [[nodiscard]] bool is_written(const std::string& aov, const std::string& type,
                                  const std::string& driver) const {
        return std::any_of(outputs_.begin(), outputs_.end(), [&](const OutputString& o) {
            return o.aov == aov && o.driver == driver && o.layer.empty() && o.camera.empty() &&
                   (o.type == type || o.type == type + "A");
        });
    }

    static std::string natural_type(std::string_view aov) {
        for (const DataAov& data : kDataAovs)
            if (data.name == aov) return std::string(data.types[0]);
        return aov == "RGBA" ? "RGBA" : "RGB";
    }

    /// A node of the kind by name; null with an error if there is none. An empty name is the default, also null.
    const NodeInstance* node_of_kind(const std::string& name, NodeKind kind,
                                     const SourceSpan& where) {
        if (name.empty()) return nullptr;
        const NodeInstance* node = input_.graph.find(name);
        if (node != nullptr && node->kind() == kind) return node;
        const std::vector<std::string> known = names_of_kind(input_.graph, kind);
        std::string hint = did_you_mean(name, known);
        if (hint.empty())
            hint = known.empty() ? "the scene has none" : "the scene has " + listed(known);
        const std::string what(kind_text(kind));
        const std::string problem =
            node == nullptr
                ? "no " + what + " is called \"" + name + '"'
                : '"' + name + "\" is a " + node->type().name.str() + ", not a " + what;
        diagnostics_.error(Code::OutputBad, problem, where, hint);
        return nullptr;
    }

    void resolve() {
        std::vector<lpe::OutputName> names;
        for (const OutputString& output : outputs_)
            names.push_back({output.aov, output.layer, output.driver, aov_place(output)});
        std::vector<std::string> others = data_aov_names();
        for (const Name name : input_.written)
            others.push_back(name.str());
        for (const Matte& matte : plan_.mattes) {
            others.push_back(matte.name.str());
            for (int i = 0; i < matte.n_layers; ++i)
                others.push_back(matte_layer(matte.name.str(), i));
        }
        const lpe::AovNames known{
            table_, {input_.light_groups.begin(), input_.light_groups.end()}, std::move(others)};
        std::vector<lpe::ResolvedOutput> resolved;
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            resolved.push_back(lpe::resolve_output(names[i], known, diagnostics_));
            plan_output(outputs_[i], resolved.back());
        }
        lpe::check_layer_names(names, resolved, diagnostics_);
        check_duplicates();
    }

    /// The AOV's name within the output string.
    static SourceSpan aov_place(const OutputString& output) {
        const std::size_t at = output.where.text().find(output.aov);
        if (!output.where.known() || at == std::string_view::npos) return output.where;
        return {output.where.source, output.where.offset + at, output.aov.size()};
    }

    void plan_output(const OutputString& output, const lpe::ResolvedOutput& resolved) {
        PlannedLayer base;
        base.info.aov_type = output.type;
        base.info.half = output.half;
        base.info.n_channels = n_channels_of(output.type);
        base.view = view_of(node_of_kind(output.filter, NodeKind::Filter, output.where));
        base.driver = driver_of(node_of_kind(output.driver, NodeKind::Driver, output.where));
        base.pass = pass_of(node_of_kind(output.camera, NodeKind::Camera, output.where));
        if (resolved.kind == lpe::ResolvedOutput::Kind::Lpe)
            plan_expression(output, resolved, base);
        if (resolved.kind == lpe::ResolvedOutput::Kind::Other) plan_data(output, base);
    }

    void plan_expression(const OutputString& output, const lpe::ResolvedOutput& resolved,
                         const PlannedLayer& base) {
        if (output.type != "RGB" && output.type != "RGBA" && output.type != "FLOAT")
            return diagnostics_.error(
                Code::OutputBad,
                "\"" + output.aov + "\" is light, it cannot be of type " + output.type,
                output.where, "RGB, RGBA and FLOAT (luminance) are possible");
        for (const lpe::LpeLayer& layer : resolved.layers) {
            PlannedLayer planned = base;
            planned.info.name = layer.layer;
            planned.info.aov = layer.aov;
            planned.info.expression = layer.expression;
            planned.info.light_group = layer.select == lpe::GroupSelect::Named     ? layer.group
                                       : layer.select == lpe::GroupSelect::Default ? "default"
                                                                                   : "";
            planned.expr = layer.expr;
            planned.select = layer.select;
            const lpe::NamedExpr* beauty = table_.find("RGBA");
            const bool is_builtin_beauty = layer.aov == "RGBA" &&
                                           layer.select == lpe::GroupSelect::All &&
                                           beauty->text == lpe::find_builtin("RGBA")->expression;
            if (is_builtin_beauty) {
                plan_.wants_beauty = true;
            } else {
                planned.source =
                    layer.expr == nullptr ? LayerSource::Black : LayerSource::Expression;
                planned.aov = request_of(layer);
            }
            plan_.layers.push_back(std::move(planned));
        }
    }

    /// A layer of what shaders write, of any type; light path expressions and data of hits come first.
    bool plan_written(const OutputString& output, const PlannedLayer& base) {
        const auto name = std::find(plan_.written.begin(), plan_.written.end(), Name(output.aov));
        if (name == plan_.written.end()) return false;
        PlannedLayer planned = base;
        planned.info.name = output.layer.empty() ? output.aov : output.layer;
        planned.info.aov = output.aov;
        planned.info.is_color = output.type == "RGB" || output.type == "RGBA";
        planned.source = LayerSource::Written;
        planned.aov = static_cast<std::uint32_t>(name - plan_.written.begin());
        plan_.layers.push_back(std::move(planned));
        return true;
    }

    /// A matte's layers in an EXR file, its preview in others; or one of its layers, asked for by name.
    bool plan_matte(const OutputString& output, const PlannedLayer& base) {
        for (std::uint32_t m = 0; m < plan_.mattes.size(); ++m) {
            const Matte& matte = plan_.mattes[m];
            if (output.aov == matte.name.str()) {
                plan_whole_matte(output, base, m);
                return true;
            }
            for (int i = 0; i < matte.n_layers; ++i)
                if (output.aov == matte_layer(matte.name.str(), i)) {
                    add_matte_layer(output, base, m, i);
                    return true;
                }
        }
        return false;
    }

    void plan_whole_matte(const OutputString& output, const PlannedLayer& base, std::uint32_t m) {
        const Matte& matte = plan_.mattes[m];
        plan_.wants_mattes = true;
        const NodeInstance* driver = plan_.drivers[base.driver].node;
        const bool holds_layers = driver == nullptr || driver->type().name == Name("driver_exr");
        const NodeInstance* filter = plan_.views[base.view].node;
        const bool* noop = filter == nullptr ? nullptr : filter->find<bool>("noop");
        if (!holds_layers || (matte.preview_in_file && (noop == nullptr || !*noop))) {
            PlannedLayer preview = base;
            preview.info.name = output.layer.empty() ? output.aov : output.layer;
            preview.info.aov = output.aov;
            preview.source = LayerSource::MattePreview;
            preview.aov = m;
            plan_.layers.push_back(std::move(preview));
        }
        if (!holds_layers) return;
        for (int i = 0; i < matte.n_layers; ++i) {
            OutputString layer = output;
            layer.aov = matte_layer(output.aov, i);
            if (!output.layer.empty()) layer.layer = matte_layer(output.layer, i);
            // Scenes that Arnold wrote out again name the layers, too.
            const bool is_named =
                std::any_of(outputs_.begin(), outputs_.end(), [&](const OutputString& other) {
                    return other.aov == layer.aov && other.driver == layer.driver &&
                           other.camera == layer.camera;
                });
            if (!is_named) add_matte_layer(layer, base, m, i);
        }
    }

    void add_matte_layer(const OutputString& output, const PlannedLayer& base, std::uint32_t m,
                         int index) {
        plan_.wants_mattes = true;
        PlannedLayer layer = base;
        layer.info.name = output.layer.empty() ? output.aov : output.layer;
        layer.info.aov = output.aov;
        layer.info.aov_type = "FLOAT";
        layer.info.n_channels = 4;
        layer.info.is_color = layer.info.half = false;
        layer.info.exact = true;
        layer.source = LayerSource::Matte;
        layer.aov = m;
        layer.rank = static_cast<std::uint32_t>(2 * index);
        const NodeInstance* filter = plan_.views[base.view].node;
        const auto* rank = filter == nullptr ? nullptr : filter->find<std::int32_t>("rank");
        if (rank != nullptr && *rank >= 0) layer.rank = static_cast<std::uint32_t>(*rank);
        plan_.layers.push_back(std::move(layer));
    }

    void plan_data(const OutputString& output, const PlannedLayer& base) {
        const auto data = std::find_if(kDataAovs.begin(), kDataAovs.end(),
                                       [&](const DataAov& d) { return d.name == output.aov; });
        if (data == kDataAovs.end()) {
            if (!plan_matte(output, base)) (void)plan_written(output, base);
            return;
        }
        if (std::find(data->types.begin(), data->types.end(), output.type) == data->types.end()) {
            std::string types;
            for (std::string_view type : data->types)
                if (!type.empty()) types += (types.empty() ? "" : ", ") + std::string(type);
            return diagnostics_.error(Code::OutputBad,
                                      "\"" + output.aov + "\" cannot be of type " + output.type,
                                      output.where, "it can be " + types);
        }
        PlannedLayer planned = base;
        planned.info.name = output.layer.empty() ? output.aov : output.layer;
        planned.info.aov = output.aov;
        planned.info.is_color =
            data->source == LayerSource::ClampLoss || data->source == LayerSource::Unclamped;
        planned.source = data->source;
        plan_.wants_clamps |= planned.info.is_color;
        plan_.wants_beauty |= planned.info.is_color;
        plan_.wants_cost |=
            data->source == LayerSource::CpuTime || data->source == LayerSource::RayCount;
        plan_.wants_pref |= data->source == LayerSource::Pref;
        plan_.wants_motion |= data->source == LayerSource::Motion;
        plan_.layers.push_back(std::move(planned));
    }

    std::uint32_t request_of(const lpe::LpeLayer& layer) {
        for (std::size_t i = 0; i < plan_.requests.size(); ++i) {
            const lpe::AovRequest& r = plan_.requests[i];
            if (r.expr == layer.expr && r.select == layer.select && r.group == layer.group)
                return static_cast<std::uint32_t>(i);
        }
        plan_.requests.push_back(layer.request());
        return static_cast<std::uint32_t>(plan_.requests.size() - 1);
    }

    std::uint32_t view_of(const NodeInstance* filter) {
        for (std::size_t i = 0; i < plan_.views.size(); ++i)
            if (plan_.views[i].node == filter) return static_cast<std::uint32_t>(i);
        plan_.views.push_back({filter, nullptr, 1, false});
        return static_cast<std::uint32_t>(plan_.views.size() - 1);
    }
    std::uint32_t driver_of(const NodeInstance* driver) {
        for (std::size_t i = 0; i < plan_.drivers.size(); ++i)
            if (plan_.drivers[i].node == driver) return static_cast<std::uint32_t>(i);
        plan_.drivers.push_back({driver, nullptr, {}});
        return static_cast<std::uint32_t>(plan_.drivers.size() - 1);
    }
    /// Passes start as one a camera; compile.cpp parts them further where filters need it.
    std::uint32_t pass_of(const NodeInstance* camera) {
        for (std::size_t i = 0; i < plan_.passes.size(); ++i)
            if (plan_.passes[i].camera_node == camera) return static_cast<std::uint32_t>(i);
        plan_.passes.push_back({camera, nullptr, 0, {}});
        return static_cast<std::uint32_t>(plan_.passes.size() - 1);
    }

    void check_duplicates() {
        std::set<std::pair<std::uint32_t, std::string>> seen;
        for (std::size_t i = 0; i < plan_.layers.size(); ++i) {
            const PlannedLayer& layer = plan_.layers[i];
            if (!seen.insert({layer.driver, layer.info.name}).second)
                diagnostics_.error(
                    Code::OutputBad,
                    "two outputs give one file a layer \"" + layer.info.name + '"', {},
                    "name one of them: a layer name may follow the driver in the output string");
            plan_.drivers[layer.driver].layers.push_back(static_cast<std::uint32_t>(i));
        }
    }

    void compile() {
        for (const lpe::AovRequest& request : plan_.requests)
            if (request.expr != nullptr)
                lpe::for_each_node(*request.expr, [&](const lpe::Node& node) {
                    plan_.wants_probes |= may_take_probe(node);
                });
        plan_.program.emplace(
            lpe::Program::compile(plan_.requests, input_.events, {}, diagnostics_));
        lint();
    }

    /// Legal outputs that will not show what was hoped for.
    void lint() {
        std::vector<lpe::LintOutput> outputs;
        std::set<const lpe::Node*> seen;
        for (const PlannedLayer& layer : plan_.layers) {
            if (layer.expr == nullptr || layer.select != lpe::GroupSelect::All) continue;
            outputs.push_back({layer.info.aov, layer.expr, {}});
            const bool is_custom = lpe::find_builtin(layer.info.aov) == nullptr;
            if (is_custom && seen.insert(layer.expr.get()).second)
                lpe::lint_in_scene(layer.expr, layer.info.aov, input_.events, diagnostics_);
        }
        lpe::lint_overlaps(outputs, diagnostics_);
        if (!input_.has_caustics) lint_caustics();
    }

    /// With `caustics` off no specular event follows a diffuse one: an AOV that needs such a pair stays black.
    void lint_caustics() {
        const lpe::Program& program = *plan_.program;
        std::vector<bool> reached(plan_.requests.size(), false);
        for (std::size_t i = 0; i < program.n_automata(); ++i)
            mark_reached_without_caustics(program.automaton(i), reached);
        for (std::size_t a = 0; a < reached.size(); ++a) {
            bool live = false;
            for (std::size_t i = 0; i < program.n_automata(); ++i)
                live |= program.automaton(i).live_aov(program.automaton(i).start(), a);
            if (live && !reached[a] && plan_.requests[a].select == lpe::GroupSelect::All)
                diagnostics_.lint(
                    Code::LpeCaustics,
                    "\"" + plan_.requests[a].name +
                        "\" only takes paths on which a specular event follows a diffuse one; "
                        "they are black while every shader has caustics off",
                    {}, "set `caustics on` on the specular shaders, as standard_surface has it");
        }
    }

    void mark_reached_without_caustics(const lpe::Automaton& automaton,
                                       std::vector<bool>& reached) const {
        const lpe::Program& program = *plan_.program;
        std::set<std::pair<lpe::State, bool>> seen;
        std::vector<std::pair<lpe::State, bool>> open{{automaton.start(), false}};
        while (!open.empty()) {
            const auto [state, after_diffuse] = open.back();
            open.pop_back();
            if (state == lpe::kDead || !seen.insert({state, after_diffuse}).second) continue;
            for (const Event& event : input_.events) {
                if (is_terminal(event.kind)) {
                    const lpe::AtomId atom = automaton.atom(state, program.terminal(event));
                    if (atom == lpe::kNoAtom) continue;
                    for (const std::uint32_t aov : program.aovs_of(atom))
                        reached[aov] = true;
                } else if (!(after_diffuse && event.lobe == EventLobe::Specular)) {
                    open.emplace_back(automaton.step(state, program.scatter_class(event)),
                                      event.lobe == EventLobe::Diffuse);
                }
            }
        }
    }

    /// Only a literal A or <A> matches a probe.
    static bool may_take_probe(const lpe::Node& node) {
        if (const auto* letter = std::get_if<lpe::Letter>(&node.form))
            return letter->letter == 'A';
        const auto* angle = std::get_if<lpe::Angle>(&node.form);
        return angle != nullptr && angle->kind.letters.find('A') != std::string::npos;
    }

    const PlanInput& input_;
    AovPlan& plan_;
    Diagnostics& diagnostics_;
    lpe::ExpressionTable table_;
    std::vector<OutputString> outputs_;
};

/// Looks among the layers of one file for sets that add up, custom ones too, and proves them.
class PartitionFinder {
  public:
    PartitionFinder(const AovPlan& plan, std::size_t driver, std::span<const Event> events)
        : plan_(plan), driver_(driver), events_(events) {
        for (const std::uint32_t index : plan.drivers[driver].layers) {
            const PlannedLayer& layer = plan.layers[index];
            const PixelFilter* filter = plan.views[layer.view].filter.get();
            const bool adds_up =
                filter != nullptr && keeps_sums(filter->reduction()) && !filter->shows_heat();
            if (layer.expr != nullptr && layer.info.n_channels >= 3 && adds_up && !layer.imaged)
                layers_.push_back(&layer);
        }
    }

    std::vector<std::string> find() {
        while (!layers_.empty()) {
            // All layers of a sum must be filtered alike and see the same camera.
            std::vector<const PlannedLayer*> alike, others;
            for (const PlannedLayer* layer : layers_) {
                const bool same =
                    layer->view == layers_.front()->view && layer->pass == layers_.front()->pass;
                (same ? alike : others).push_back(layer);
            }
            try {
                find_among(alike);
            } catch (const InputError&) {
                // Over the budget of a proof: nothing is claimed.
            }
            layers_ = std::move(others);
        }
        find_clamps();
        return std::move(found_);
    }

  private:
    /// What clamps took away and what they left is what there was: not by a proof, but by how it is stored.
    void find_clamps() {
        const auto layers_of = [&](LayerSource source) {
            std::vector<const PlannedLayer*> out;
            for (const std::uint32_t index : plan_.drivers[driver_].layers)
                if (plan_.layers[index].source == source && !plan_.layers[index].imaged &&
                    plan_.layers[index].info.n_channels >= 3)
                    out.push_back(&plan_.layers[index]);
            return out;
        };
        for (const PlannedLayer* whole : layers_of(LayerSource::Unclamped))
            for (const PlannedLayer* beauty : layers_of(LayerSource::Beauty))
                for (const PlannedLayer* loss : layers_of(LayerSource::ClampLoss)) {
                    const auto alike = [&](const PlannedLayer& l) {
                        return l.view == whole->view && l.pass == whole->pass;
                    };
                    if (alike(*beauty) && alike(*loss) &&
                        keeps_sums(plan_.views[whole->view].filter->reduction()))
                        found_.push_back(whole->info.name + " = " + beauty->info.name + " + " +
                                         loss->info.name);
                }
    }

    /// Sums that are claimed for one layer at most.
    static constexpr std::size_t kMaxSums = 4;

    /// Sums that hold over all paths; for a layer that has none, those that hold in this scene.
    void find_among(const std::vector<const PlannedLayer*>& layers) {
        std::vector<lpe::AovRequest> requests;
        for (const PlannedLayer* layer : layers)
            requests.push_back(
                {layer->info.name, layer->expr, layer->select, layer->info.light_group});
        const std::vector<lpe::Region> everywhere =
            lpe::regions(requests, lpe::possible_events(requests, plan_.light_groups));
        const std::vector<lpe::Region> here = lpe::regions(requests, events_);
        for (std::uint32_t whole = 0; whole < layers.size(); ++whole)
            if (!remember(layers, lpe::find_sums(everywhere, layers.size(), whole, kMaxSums)))
                remember(layers, lpe::find_sums(here, layers.size(), whole, kMaxSums));
    }

    bool remember(const std::vector<const PlannedLayer*>& layers,
                  const std::vector<lpe::Sum>& sums) {
        for (const lpe::Sum& sum : sums) {
            std::string text;
            for (const std::uint32_t part : sum.parts)
                text += (text.empty() ? " = " : " + ") + layers[part]->info.name;
            text = layers[sum.whole]->info.name + text;
            if (std::find(found_.begin(), found_.end(), text) == found_.end())
                found_.push_back(std::move(text));
        }
        return !sums.empty();
    }

    const AovPlan& plan_;
    std::size_t driver_;
    std::span<const Event> events_;
    std::vector<const PlannedLayer*> layers_;
    std::vector<std::string> found_;
};

}  // namespace

std::size_t n_channels_of(std::string_view aov_type) {
    if (aov_type == "RGBA") return 4;
    return aov_type == "RGB" || aov_type == "VECTOR" ? 3 : aov_type == "VECTOR2" ? 2 : 1;
}

std::vector<std::string> data_aov_names() {
    std::vector<std::string> out;
    for (const DataAov& data : kDataAovs)
        out.emplace_back(data.name);
    return out;
}

std::optional<OutputString> parse_output(std::string_view text, const SourceSpan& where,
                                         Diagnostics& diagnostics) {
    constexpr const char* kForm =
        "an output is \"[camera] aov TYPE filter driver [layer] [HALF]\"";
    std::vector<std::string> words = split_blanks(text);
    const auto is_type = [](const std::string& word) {
        return std::find(kTypes.begin(), kTypes.end(), word) != kTypes.end();
    };
    OutputString out;
    out.where = where;
    if (words.size() > 4 && words.back() == "HALF") {
        out.half = true;
        words.pop_back();
    }
    for (std::size_t i : {1U, 2U})
        if (i < words.size() && (words[i] == "NODE" || words[i] == "POINTER")) {
            diagnostics.error(Code::OutputBad,
                              "AOVs of type " + words[i] + " cannot be written to pictures", where,
                              "RGB RGBA FLOAT INT UINT BOOL VECTOR VECTOR2 can");
            return std::nullopt;
        }
    const bool with_camera =
        words.size() > 2 && is_type(words[2]) && !(is_type(words[1]) && words.size() < 5);
    const std::size_t type_at = with_camera ? 2 : 1;
    if (words.size() <= type_at || !is_type(words[type_at])) {
        const std::vector<std::string> types(kTypes.begin(), kTypes.end());
        std::string hint = words.size() > 1 ? did_you_mean(words[1], types) : std::string();
        diagnostics.error(Code::OutputBad, "output \"" + std::string(text) + "\" names no type",
                          where, hint.empty() ? kForm : hint);
        return std::nullopt;
    }
    if (words.size() < type_at + 3 || words.size() > type_at + 4) {
        diagnostics.error(Code::OutputBad,
                          "output \"" + std::string(text) + "\" has " +
                              (words.size() < type_at + 3 ? "too few" : "too many") + " words",
                          where, kForm);
        return std::nullopt;
    }
    if (with_camera) out.camera = words[0];
    out.aov = words[type_at - 1];
    out.type = words[type_at];
    out.filter = words[type_at + 1];
    out.driver = words[type_at + 2];
    if (words.size() > type_at + 3) out.layer = words[type_at + 3];
    return out;
}

std::vector<std::string> proved_partitions(const AovPlan& plan, std::size_t driver,
                                           std::span<const Event> events) {
    return PartitionFinder(plan, driver, events).find();
}

void plan_layers(const PlanInput& input, AovPlan& plan, Diagnostics& diagnostics) {
    Planner(input, plan, diagnostics).run();
}

}  // namespace lightsieve

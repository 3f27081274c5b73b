// From the AOV name of an output string to expressions and light groups: `diffuse`, `diffuse_*`,
// `diffuse_key`.
//
// Pure string logic over the names that exist; nodes, drivers and pixels are the renderer's. The
// order of the rules is: an expression's name, a non-LPE AOV, `E_*`, `E_group`
// with the longest E, an error that suggests names. All groups of an expression together take each
// of its light paths exactly once (GroupSelect::Default is the rest).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "lpe/builtins.h"
#include "lpe/program.h"

namespace lightsieve::lpe {

/// What one output string asks for.
struct OutputName {
    std::string name;    ///< the AOV as written: "diffuse_*"
    std::string layer;   ///< the layer name given after the driver; empty if none
    std::string driver;  ///< layers of one driver must differ in name
    SourceSpan where{};  ///< the name in the scene file
};

/// The names that outputs are looked up in.
struct AovNames {
    const ExpressionTable& expressions;
    std::vector<std::string> groups;  ///< of the scene's lights; empty and `default` are ignored
    std::vector<std::string> others;  ///< non-LPE AOVs: built in, or written by a shader
};

/// One layer of an output.
struct LpeLayer {
    std::string layer;  ///< name in the file: given, "diffuse", "diffuse_key", "diffuse_default"
    std::string aov;    ///< name of the expression
    std::string expression;  ///< its text, for the file's header
    Expr expr;               ///< null: it had an error, the layer is black
    GroupSelect select = GroupSelect::All;
    std::string group{};  ///< the light group, for GroupSelect::Named

    /// What to compile for this layer.
    [[nodiscard]] AovRequest request() const { return {layer, expr, select, group}; }
};

struct ResolvedOutput {
    enum class Kind : std::uint8_t {
        Lpe,      ///< `layers` has one layer, or with a wildcard one per group
        Other,    ///< a non-LPE AOV
        Unknown,  ///< an error was reported
    };
    Kind kind = Kind::Unknown;
    std::vector<LpeLayer> layers{};
};

/// Resolves one output's name.
///
/// diagnostics  gets: an unknown name with the nearest ones (error); a group suffix on an albedo
///              AOV (error); a group that no light has, with the groups there are (warning: the
///              layer is black)
[[nodiscard]] ResolvedOutput resolve_output(const OutputName& output, const AovNames& names,
                                            Diagnostics& diagnostics);

/// Reports layers of a wildcard that have the name of another layer of the same driver (error:
/// asks for a layer name).
///
/// outputs, resolved  the outputs of a render and what `resolve_output` made of them, index by
///                    index
void check_layer_names(std::span<const OutputName> outputs,
                       std::span<const ResolvedOutput> resolved, Diagnostics& diagnostics);

}  // namespace lightsieve::lpe

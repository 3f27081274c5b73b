#include "lpe/light_groups.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "lpe/algebra.h"
#include "lpe/cursor.h"

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kDefaultGroup = "default";
constexpr std::string_view kWildcard = "_*";

/// One way to read a name as an expression and a group.
struct Split {
    const NamedExpr* expression;
    std::string group;
};

class Resolver {
  public:
    Resolver(const OutputName& output, const AovNames& names, Diagnostics& diagnostics)
        : output_(output),
          names_(names),
          diagnostics_(diagnostics),
          name_(canonical_name(output.name)) {
        for (const std::string& group : names.groups)
            if (!group.empty() && group != kDefaultGroup) groups_.insert(group);
    }

    ResolvedOutput resolve() {
        // 1. An expression's name.
        if (const NamedExpr* named = names_.expressions.find(name_))
            return {ResolvedOutput::Kind::Lpe, {layer(*named, layer_or(name_), GroupSelect::All)}};
        // 2. A non-LPE AOV.
        if (std::ranges::find(names_.others, output_.name) != names_.others.end())
            return {ResolvedOutput::Kind::Other, {}};
        // 3. One layer for each group.
        if (name_.ends_with(kWildcard)) {
            const std::string base = name_.substr(0, name_.size() - kWildcard.size());
            if (const NamedExpr* named = names_.expressions.find(base)) return all_groups(*named);
        }
        // 4. One group.
        if (const std::optional<Split> split = best_split()) return one_group(*split);
        // 5. Nothing fits.
        std::vector<std::string> known = names_.expressions.names();
        known.insert(known.end(), names_.others.begin(), names_.others.end());
        const std::string guess = did_you_mean(output_.name, known);
        diagnostics_.error(
            Code::LpeUnknownAov, "no AOV " + in_quotes(output_.name), output_.where,
            guess.empty() ? "`lightsieve lpe list` lists the built-in ones" : guess);
        return {};
    }

  private:
    [[nodiscard]] std::string layer_or(const std::string& name) const {
        return output_.layer.empty() ? name : output_.layer;
    }

    [[nodiscard]] static LpeLayer layer(const NamedExpr& named, std::string layer_name,
                                        GroupSelect select, std::string group = {}) {
        return {std::move(layer_name), named.name, named.text, named.expr, select,
                std::move(group)};
    }

    /// A group of an AOV that ends at no light is an error.
    bool may_have_groups(const NamedExpr& named) {
        if (!named.expr || takes_light(named.expr) || !takes_probe(named.expr)) return true;
        diagnostics_.error(Code::LpeGroupSuffix,
                           in_quotes(output_.name) + ": albedo has no light groups", output_.where,
                           "a probe ends at no light; ask for " + in_quotes(named.name));
        return false;
    }

    ResolvedOutput all_groups(const NamedExpr& named) {
        if (!may_have_groups(named)) return {};
        ResolvedOutput resolved{ResolvedOutput::Kind::Lpe, {}};
        const std::string base = layer_or(named.name) + "_";
        for (const std::string& group : groups_)
            resolved.layers.push_back(layer(named, base + group, GroupSelect::Named, group));
        resolved.layers.push_back(
            layer(named, base + std::string(kDefaultGroup), GroupSelect::Default));
        return resolved;
    }

    /// Among the splits at a group that exists, the one with the longest expression; else the
    /// longest of all.
    [[nodiscard]] std::optional<Split> best_split() const {
        std::optional<Split> longest;
        for (std::size_t at = name_.rfind('_'); at != std::string::npos && at > 0;
             at = name_.rfind('_', at - 1)) {
            const NamedExpr* named = names_.expressions.find(name_.substr(0, at));
            std::string group = name_.substr(at + 1);
            if (named == nullptr || group.empty()) continue;
            if (group == kDefaultGroup || groups_.contains(group))
                return Split{named, std::move(group)};
            if (!longest) longest = Split{named, std::move(group)};
        }
        return longest;
    }

    ResolvedOutput one_group(const Split& split) {
        if (!may_have_groups(*split.expression)) return {};
        const bool rest = split.group == kDefaultGroup;
        if (!rest && !groups_.contains(split.group)) warn_unknown_group(split);
        LpeLayer found = layer(*split.expression, layer_or(name_),
                               rest ? GroupSelect::Default : GroupSelect::Named,
                               rest ? std::string{} : split.group);
        return {ResolvedOutput::Kind::Lpe, {std::move(found)}};
    }

    void warn_unknown_group(const Split& split) {
        std::string hint = did_you_mean(split.group, {groups_.begin(), groups_.end()});
        if (!hint.empty()) hint += " ";
        hint += "the scene's groups are ";
        for (const std::string& group : groups_)
            hint += in_quotes(group) + ", ";
        hint += in_quotes(kDefaultGroup);
        diagnostics_.warning(
            Code::LpeGroupUnknown,
            in_quotes(output_.name) + " is black: no light is in group " + in_quotes(split.group),
            output_.where, std::move(hint));
    }

    const OutputName& output_;
    const AovNames& names_;
    Diagnostics& diagnostics_;
    std::string name_;
    std::set<std::string> groups_;  ///< named ones
};

}  // namespace

ResolvedOutput resolve_output(const OutputName& output, const AovNames& names,
                              Diagnostics& diagnostics) {
    return Resolver(output, names, diagnostics).resolve();
}

void check_layer_names(std::span<const OutputName> outputs,
                       std::span<const ResolvedOutput> resolved, Diagnostics& diagnostics) {
    // Per driver and layer name: the output that has it first.
    std::map<std::pair<std::string, std::string>, std::size_t> owner;
    const auto name_of_other = [&](std::size_t i) {
        return outputs[i].layer.empty() ? outputs[i].name : outputs[i].layer;
    };
    const auto is_wildcard = [&](std::size_t i) { return outputs[i].name.ends_with(kWildcard); };
    const auto add = [&](std::size_t i, const std::string& layer) {
        const auto [entry, is_new] = owner.emplace(std::pair{outputs[i].driver, layer}, i);
        const std::size_t other = entry->second;
        if (is_new || (!is_wildcard(i) && !is_wildcard(other))) return;
        const std::size_t wild = is_wildcard(i) ? i : other;
        diagnostics.add(
            {Code::LpeLayerName,
             in_quotes(outputs[wild].name) + " makes a second layer " + in_quotes(layer),
             outputs[wild].where,
             "give it a layer name after the driver",
             {{"the other is output " + in_quotes(outputs[wild == i ? other : i].name),
               outputs[wild == i ? other : i].where}},
             Severity::Error});
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (resolved[i].kind == ResolvedOutput::Kind::Other) add(i, name_of_other(i));
        for (const LpeLayer& layer : resolved[i].layers)
            add(i, layer.layer);
    }
}

}  // namespace lightsieve::lpe

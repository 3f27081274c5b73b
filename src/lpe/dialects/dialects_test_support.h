// For the tests of dialects: common paths as text, and a second, naive matcher of patterns.
//
// The matcher tries every way to divide a path among the parts. It shares the readers and the
// dialects' views with the translator, but no set, no position and no automaton.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lpe/dialects/dialect.h"

namespace lightsieve::lpe::dialects {

/// Reads `C RG'coat'@'hero' Ts L'key'`; labels hold no blanks. Throws std::invalid_argument.
inline CommonPath must_common_path(const std::string& text) {
    const auto kind_of = [](char letter) {
        switch (letter) {
            case 'C': return CommonKind::Camera;
            case 'R': return CommonKind::Reflection;
            case 'T': return CommonKind::Transmission;
            case 'V': return CommonKind::Volume;
            case 'L': return CommonKind::Light;
            case 'O': return CommonKind::Object;
            case 'B': return CommonKind::Background;
            case 'A': return CommonKind::Probe;
            case 'U': return CommonKind::Foreign;
            case 'M': return CommonKind::ForeignEnd;
            default: throw std::invalid_argument("no common event");
        }
    };
    CommonPath path;
    std::istringstream words(text);
    bool seen = true;
    for (std::string word; words >> word;) {
        CommonEvent event;
        event.kind = kind_of(word.at(0));
        std::size_t at = 1;
        if (word == "Ts") {
            event.kind = CommonKind::Straight;
        } else if (event.kind == CommonKind::Foreign || event.kind == CommonKind::ForeignEnd) {
            // MoonRay's U ends a path, RenderMan's U2 does not.
            if (word == "U") event.kind = CommonKind::ForeignEnd;
            event.name = word;
        } else {
            if (at < word.size() && word[at] == 'D') event.lobe = CommonLobe::Diffuse;
            if (at < word.size() && word[at] == 'G') event.lobe = CommonLobe::Glossy;
            if (at < word.size() && word[at] == 'S') event.lobe = CommonLobe::Mirror;
            if (event.lobe != CommonLobe::None) ++at;
            while (at < word.size()) {
                const bool object = word[at] == '@';
                const std::size_t begin = at + (object ? 2 : 1), end = word.find('\'', begin);
                const std::string label = word.substr(begin, end - begin);
                const bool group =
                    event.kind == CommonKind::Light || event.kind == CommonKind::Background;
                (object ? event.object : group ? event.group : event.label) = label;
                at = end + 1;
            }
        }
        const bool sees = event.kind == CommonKind::Light || event.kind == CommonKind::Background;
        event.seen = sees && seen;
        seen = seen && (event.kind == CommonKind::Camera || event.kind == CommonKind::Straight);
        path.push_back(std::move(event));
    }
    return path;
}

/// Where matching the pattern can end if it begins at `begin`.
inline std::set<std::size_t> naive_ends(const Pattern& pattern, const std::vector<Hit>& hits,
                                        std::size_t begin) {
    switch (pattern.form) {
        case Pattern::Form::Empty: return {begin};
        case Pattern::Form::Event:
            if (begin < hits.size() && pattern.test(hits[begin])) return {begin + 1};
            return {};
        case Pattern::Form::Sequence: {
            std::set<std::size_t> now{begin};
            for (const PatternPtr& part : pattern.parts) {
                std::set<std::size_t> next;
                for (const std::size_t at : now)
                    next.merge(naive_ends(*part, hits, at));
                now = std::move(next);
            }
            return now;
        }
        case Pattern::Form::Alternation: {
            std::set<std::size_t> out;
            for (const PatternPtr& part : pattern.parts)
                out.merge(naive_ends(*part, hits, begin));
            return out;
        }
        case Pattern::Form::Repeat: {
            std::set<std::size_t> now{begin}, out;
            const std::size_t most = std::min<std::size_t>(
                pattern.max, pattern.min + hits.size() - std::min(begin, hits.size()));
            for (std::size_t n = 0; n <= most && !now.empty(); ++n) {
                if (n >= pattern.min) out.insert(now.begin(), now.end());
                std::set<std::size_t> next;
                for (const std::size_t at : now)
                    next.merge(naive_ends(*pattern.parts[0], hits, at));
                now = std::move(next);
            }
            return out;
        }
        default: return {};
    }
}

/// Does the text, as the dialect reads it, take the path?
inline bool naive_takes(const Dialect& dialect, const std::string& text, const CommonPath& path) {
    if (text.empty()) return false;
    Diagnostics diagnostics;
    const Reading reading = dialect.read(text, {}, diagnostics);
    if (!reading.pattern) throw std::invalid_argument(diagnostics.render());
    std::vector<Hit> hits;
    for (const CommonEvent& event : path) {
        const View view = dialect.view(event);
        if (view.form == View::Form::Absent) return false;
        if (view.form == View::Form::Hit) hits.push_back(view.hit);
    }
    return naive_ends(*reading.pattern, hits, 0).contains(hits.size());
}

}  // namespace lightsieve::lpe::dialects

// Every path of a render as a list of events with what it carried: for people who debug, and the tests' oracle.
//
// The same integrator runs, but each share of a path keeps its whole history instead of a state, so nothing merges.
// Adding up the logged paths that an expression takes, decided by any matcher, must give that expression's AOV.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/trackers.h"

namespace lightsieve {

/// A tree of event sequences; a state is a node of it.
struct HistoryMachine {
    using State = std::uint32_t;
    static constexpr std::size_t kMaxTerms = std::size_t{1} << 20U;
    /// Shared by the terms of one log: nodes as (parent, event).
    std::vector<std::pair<std::uint32_t, std::uint32_t>>* nodes = nullptr;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>* index = nullptr;
    [[nodiscard]] State start() const { return 0; }
    [[nodiscard]] State step(State state, const LobeRecord& record) const;
    [[nodiscard]] static bool live(State) { return true; }
};

/// One share of light that arrived.
struct LoggedPath {
    int x = 0, y = 0;                   ///< pixel of the frame
    std::vector<std::uint32_t> events;  ///< indices into Scene::events, the camera event left out
    Color value;                        ///< before division by the number of samples
};

class LogTracker {
  public:
    explicit LogTracker(const Scene& scene);
    void start(Color throughput, SampleBuffer& out);
    using Saved = PathTerms<HistoryMachine>;
    void save(Saved& to) const { to.copy_from(terms_); }
    void restore(const Saved& from) { terms_.copy_from(from); }
    void scale(Color factor) { terms_.scale(factor); }
    void keep_only(std::size_t group, float factor) { terms_.keep_only(group, factor); }
    template <class Random>
    void scatter(std::span<const Channel> channels, std::span<const Color> factors,
                 const PathGroups::Step& step, const Random& random) {
        terms_.scatter(machine_, channels, factors, step, random);
    }
    [[nodiscard]] bool live() const { return !terms_.empty(); }
    [[nodiscard]] static bool live_probe() { return true; }
    [[nodiscard]] static bool takes(lpe::TerminalId) { return true; }
    [[nodiscard]] static bool takes(std::span<const Channel>, lpe::TerminalId) { return true; }
    [[nodiscard]] static bool goes_on(const Channel&) { return true; }
    template <class Value>
    void add(Terminal terminal, const Value& value, float scale) {
        for (const auto& t : terms_.all())
            store(t.state, terminal, t.throughput * value(t.group) * scale);
    }
    template <class Value>
    void add_scattered(std::span<const Channel> channels, Terminal terminal, const Value& value,
                       float scale) {
        for (const auto& t : terms_.all())
            for (std::size_t c = 0; c < channels.size(); ++c)
                store(machine_.step(t.state, *channels[c].record), terminal,
                      t.throughput * value(t.group, c) * scale);
    }

    int x = 0, y = 0;               ///< set before each sample
    std::vector<LoggedPath> paths;  ///< everything that arrived

  private:
    void store(HistoryMachine::State state, Terminal terminal, Color value);

    std::vector<std::pair<std::uint32_t, std::uint32_t>> nodes_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> index_;
    HistoryMachine machine_;
    PathTerms<HistoryMachine> terms_;
};

/// Logs every path of the scene's first pass, `factor` of clamping included. For small pictures: memory grows with every path.
[[nodiscard]] std::vector<LoggedPath> log_paths(const Scene& scene);

/// The log as text, one path a line: `x y  C RD L'key'  r g b`.
[[nodiscard]] std::string path_log_text(const Scene& scene, std::span<const LoggedPath> paths);

}  // namespace lightsieve

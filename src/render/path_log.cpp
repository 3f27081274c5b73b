#include "render/path_log.h"

#include <fmt/format.h>

#include "lpe/match.h"
#include "render/camera_sample.h"
#include "render/integrator.h"

namespace lightsieve {

HistoryMachine::State HistoryMachine::step(State state, const LobeRecord& record) const {
    if (record.makes_no_event) return state;
    const auto [at, is_new] =
        index->try_emplace({state, record.event}, static_cast<State>(nodes->size()));
    if (is_new) nodes->emplace_back(state, record.event);
    return at->second;
}

LogTracker::LogTracker(const Scene&) : nodes_{{0, 0}}, machine_{&nodes_, &index_} {}

void LogTracker::start(Color throughput, SampleBuffer&) { terms_.start(machine_, throughput); }

void LogTracker::store(HistoryMachine::State state, Terminal terminal, Color value) {
    if (is_black(value)) return;
    LoggedPath path{x, y, {}, value};
    for (HistoryMachine::State s = state; s != 0; s = nodes_[s].first)
        path.events.insert(path.events.begin(), nodes_[s].second);
    path.events.push_back(terminal.event);
    paths.push_back(std::move(path));
}

std::vector<LoggedPath> log_paths(const Scene& scene) {
    const Pass& pass = scene.plan.passes.at(0);
    const CameraSampler camera(scene, pass);
    Integrator<LogTracker> integrator(scene);
    const GuideTraining training = train_guide(scene, [](std::uint64_t) {}, nullptr);
    integrator.set_guide(training.guide.get());
    LogTracker& log = integrator.tracker();
    SampleBuffer buffer;
    const Region& region = scene.settings.region;
    for (int y = region.y0; y <= region.y1; ++y)
        for (int x = region.x0; x <= region.x1; ++x)
            for (int i = 0; i < scene.settings.samples; ++i) {
                const std::size_t first = log.paths.size();
                log.x = x;
                log.y = y;
                const CameraSample sample = camera.sample(x, y, static_cast<std::uint32_t>(i));
                integrator.state = sample.state;
                integrator.trace(sample.ray, sample.time, sample.camera_from_world, sample.sampler,
                                 buffer);
                const float scale = sample_clamp_factor(scene, buffer.beauty);
                for (std::size_t p = first; p < log.paths.size(); ++p)
                    if (log.paths[p].events.back() != scene.probe_event)
                        log.paths[p].value *= scale;
            }
    return std::move(log.paths);
}

std::string path_log_text(const Scene& scene, std::span<const LoggedPath> paths) {
    std::string out;
    for (const LoggedPath& path : paths) {
        std::vector<Event> events{{EventKind::Camera, EventLobe::None, {}}};
        for (std::uint32_t e : path.events)
            events.push_back(scene.events[e]);
        out += fmt::format("{} {}  {}  {} {} {}\n", path.x, path.y, lpe::print_path(events),
                           path.value.r, path.value.g, path.value.b);
    }
    return out;
}

}  // namespace lightsieve

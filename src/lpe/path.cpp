#include "lpe/path.h"

#include <algorithm>
#include <array>

#include "lpe/cursor.h"
#include "lpe/parse.h"

namespace lightsieve::lpe {
namespace {

constexpr std::string_view kDefaultGroup = "default";
/// A lobe label and an object label.
constexpr std::size_t kMaxLabels = 2;

struct KindLetter {
    char letter;
    EventKind kind;
};
constexpr std::array kKinds{
    KindLetter{'C', EventKind::Camera},       KindLetter{'R', EventKind::Reflection},
    KindLetter{'T', EventKind::Transmission}, KindLetter{'V', EventKind::Volume},
    KindLetter{'L', EventKind::Light},        KindLetter{'O', EventKind::Object},
    KindLetter{'B', EventKind::Background},   KindLetter{'A', EventKind::Albedo},
};

bool has_lobe(EventKind kind) {
    return kind == EventKind::Reflection || kind == EventKind::Transmission;
}

/// Reads one event after the other; stops at the first that is wrong.
class PathReader {
  public:
    explicit PathReader(Cursor& in) : in_(in) {}

    bool read(Path& path) {
        while (in_.skip_blanks(), !in_.at_end()) {
            const std::size_t begin = in_.position();
            if (!path.empty() && !blank_before(begin))
                return reject("no blank between two events", begin, "write C RD L");
            Event event;
            if (!read_event(event) || !check_place(path, event, begin)) return false;
            path.push_back(std::move(event));
        }
        if (!path.empty() && is_terminal(path.back().kind)) return true;
        const std::size_t end = in_.position();
        return reject(path.empty() ? "the path is empty" : "the path does not end", end,
                      "a path is C, scattering events, then one of L O B A: C RD L");
    }

  private:
    bool reject(const std::string& message, std::size_t begin, std::string hint) {
        const std::size_t end = std::max(in_.position(), std::min(begin + 1, in_.text().size()));
        in_.error(Code::LpePath, message, begin, end, std::move(hint));
        return false;
    }
    [[nodiscard]] bool blank_before(std::size_t position) const {
        return kBlanks.find(in_.text()[position - 1]) != std::string_view::npos;
    }

    bool read_event(Event& event) {
        const std::size_t begin = in_.position();
        const bool angle = in_.take_if('<');
        in_.skip_blanks();
        if (!read_kind(event) || !read_lobe(event, angle) || !read_labels(event, angle))
            return false;
        if (angle && !in_.take_if('>'))
            return reject("\"<\" is never closed", begin, "close it with \">\"");
        return true;
    }

    bool read_kind(Event& event) {
        const std::size_t begin = in_.position();
        const char letter = in_.peek();
        const auto row = std::ranges::find(kKinds, letter, &KindLetter::letter);
        if (row != kKinds.end() && !in_.at_end()) {
            in_.take();
            event.kind = row->kind;
            return true;
        }
        if (in_.at_end()) return reject("\"<\" is never closed", begin, "name an event: <RD>");
        if (letter == 'D' || letter == 'S') {
            const std::string lobe{letter};
            return reject(in_quotes(lobe) + " is no single event", begin,
                          "say what happened: R" + lobe + " or T" + lobe);
        }
        if (letter == '.' || letter == '[')
            return reject("a path holds single events", begin, "one of RD RS TD TS V L O B A");
        in_.reject_character();
        return false;
    }

    bool read_lobe(Event& event, bool angle) {
        skip_blanks_if(angle);
        const std::size_t begin = in_.position();
        if (has_lobe(event.kind)) {
            if (in_.take_if('D')) return event.lobe = EventLobe::Diffuse, true;
            if (in_.take_if('S')) return event.lobe = EventLobe::Specular, true;
            const std::string kind{event.kind == EventKind::Reflection ? 'R' : 'T'};
            return reject(in_quotes(kind) + " is no single event", begin - 1,
                          "say which lobe: " + kind + "D or " + kind + "S");
        }
        // The place of the lobe, as in <L.'key'>.
        in_.take_if('.');
        return true;
    }

    bool read_labels(Event& event, bool angle) {
        const std::size_t begin = in_.position();
        const std::size_t errors_before = in_.n_errors();
        for (skip_blanks_if(angle); in_.peek() == '\''; skip_blanks_if(angle))
            event.labels.push_back(in_.read_label());
        if (in_.n_errors() > errors_before) return false;
        std::ranges::sort(event.labels);
        event.labels.erase(std::unique(event.labels.begin(), event.labels.end()),
                           event.labels.end());
        const std::size_t most = max_labels(event.kind);
        if (event.labels.size() > most)
            return reject(most == 0 ? "this event carries no label" : "too many labels", begin,
                          "a lobe carries two at most, a light its one group");
        if (event.kind == EventKind::Light && event.labels.empty())
            event.labels.emplace_back(kDefaultGroup);
        return true;
    }

    static std::size_t max_labels(EventKind kind) {
        switch (kind) {
            case EventKind::Camera:
            case EventKind::Albedo: return 0;
            case EventKind::Light:
            case EventKind::Background: return 1;
            default: return kMaxLabels;
        }
    }

    bool check_place(const Path& path, const Event& event, std::size_t begin) {
        if (path.empty() != (event.kind == EventKind::Camera))
            return reject(path.empty() ? "the path does not start with C" : "C stands only first",
                          begin, "a path is read from the camera: C RD L");
        if (!path.empty() && is_terminal(path.back().kind))
            return reject("the path goes on after it has ended", begin, "L O B A stand only last");
        if (path.size() == 1 && event.kind == EventKind::Albedo)
            return reject("a probe without a vertex", begin,
                          "the albedo of a first hit is C RD A");
        return true;
    }

    void skip_blanks_if(bool angle) {
        if (angle) in_.skip_blanks();
    }

    Cursor& in_;
};

}  // namespace

std::optional<Path> parse_path(std::string_view text, const SourceSpan& base,
                               Diagnostics& diagnostics) {
    Cursor in(text, base.known() ? base : stand_alone(text, "<path>"), "", diagnostics);
    Path path;
    if (!PathReader(in).read(path)) return std::nullopt;
    return path;
}

std::optional<Path> parse_path(std::string_view text, Diagnostics& diagnostics) {
    return parse_path(text, SourceSpan{}, diagnostics);
}

std::string print_event(const Event& event) {
    std::string out{std::ranges::find(kKinds, event.kind, &KindLetter::kind)->letter};
    if (event.lobe == EventLobe::Diffuse) out += 'D';
    if (event.lobe == EventLobe::Specular) out += 'S';
    for (const std::string& label : event.labels)
        if (event.kind != EventKind::Light || label != kDefaultGroup) out += "'" + label + "'";
    return out;
}

std::string print_path(std::span<const Event> path) {
    std::string out;
    for (const Event& event : path)
        out += (out.empty() ? "" : " ") + print_event(event);
    return out;
}

bool is_path(std::span<const Event> path) {
    if (path.size() < 2 || path.front().kind != EventKind::Camera) return false;
    if (!is_terminal(path.back().kind)) return false;
    if (path.size() == 2 && path.back().kind == EventKind::Albedo) return false;
    const auto scatters = [](const Event& event) {
        return event.kind != EventKind::Camera && !is_terminal(event.kind);
    };
    return std::all_of(path.begin() + 1, path.end() - 1, scatters);
}

}  // namespace lightsieve::lpe

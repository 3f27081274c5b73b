// The C interface, include/lightsieve/lightsieve.h. Nothing leaves a function by an exception.
#include "lightsieve/lightsieve.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "core/version.h"
#include "embed/flat_tables.h"
#include "lpe/lint.h"
#include "lpe/parse.h"

namespace {

using namespace lightsieve;

/// An AOV as it was added.
struct Wanted {
    std::string name, expression;
    std::optional<std::string> group;
};

/// What a lightsieve_diagnostic points into.
struct Report {
    Severity severity;
    std::string code, message, hint, expression, text;
    std::uint32_t column;
};

Report report_of(const Error& error) {
    Report out{error.severity,
               std::string(code_text(error.code)),
               error.message,
               error.hint,
               {},
               error.render(),
               0};
    if (error.where.known()) {
        out.expression = error.where.source->text;
        out.column = static_cast<std::uint32_t>(error.where.line_column().column);
    }
    return out;
}

/// The engine's event, or nothing for one that cannot be.
std::optional<Event> engine_event(const lightsieve_event& given) {
    static constexpr EventKind kKinds[] = {
        EventKind::Reflection, EventKind::Transmission, EventKind::Volume, EventKind::Light,
        EventKind::Object,     EventKind::Background,   EventKind::Albedo};
    static constexpr EventLobe kLobes[] = {EventLobe::None, EventLobe::Diffuse,
                                           EventLobe::Specular};
    const auto kind = static_cast<std::size_t>(given.kind);
    const auto lobe = static_cast<std::size_t>(given.lobe);
    if (kind >= std::size(kKinds) || lobe >= std::size(kLobes)) return std::nullopt;
    Event event{kKinds[kind], kLobes[lobe], {}};
    const bool leaves_surface =
        event.kind == EventKind::Reflection || event.kind == EventKind::Transmission;
    if (leaves_surface == (event.lobe == EventLobe::None)) return std::nullopt;
    if (given.n_labels > 0 && given.labels == nullptr) return std::nullopt;
    for (std::size_t i = 0; i < given.n_labels; ++i) {
        if (given.labels[i] == nullptr || *given.labels[i] == '\0') return std::nullopt;
        event.labels.emplace_back(given.labels[i]);
    }
    std::ranges::sort(event.labels);
    event.labels.erase(std::ranges::unique(event.labels).begin(), event.labels.end());
    const bool in_group = event.kind == EventKind::Light || event.kind == EventKind::Background;
    if (in_group && event.labels.size() > 1) return std::nullopt;
    // A light that was put into no group is in the one of that name.
    if (event.kind == EventKind::Light && event.labels.empty()) event.labels = {"default"};
    return event;
}

/// Reads the expression of an AOV and says what is wrong with it.
lpe::AovRequest request_of(const Wanted& wanted, bool standard, Diagnostics& diagnostics) {
    lpe::ParseOptions options;
    options.aov_name = wanted.name;
    options.standard = standard;
    const SourceSpan where = lpe::stand_alone(wanted.expression);
    lpe::AovRequest out{wanted.name, lpe::parse(wanted.expression, where, diagnostics, options)};
    lpe::lint_expression(wanted.expression, where, wanted.name, out.expr, diagnostics);
    if (wanted.group) {
        out.select =
            *wanted.group == "default" ? lpe::GroupSelect::Default : lpe::GroupSelect::Named;
        out.group = *wanted.group;
    }
    return out;
}

}  // namespace

struct lightsieve_compiler {
    std::vector<Wanted> aovs;
    std::vector<Event> events;
    std::vector<Report> reports;
    bool standard = false;
};

struct lightsieve_program {
    embed::FlatTables flat;
    std::uint32_t n_aovs;
};

const char* lightsieve_version() { return kVersion.data(); }

lightsieve_compiler* lightsieve_compiler_create() {
    try {
        return new lightsieve_compiler();
    } catch (...) {
        return nullptr;
    }
}

void lightsieve_compiler_destroy(lightsieve_compiler* compiler) { delete compiler; }

uint32_t lightsieve_add_aov(lightsieve_compiler* compiler, const char* name,
                            const char* expression, const char* group) {
    if (compiler == nullptr || name == nullptr || expression == nullptr) return LIGHTSIEVE_NONE;
    try {
        Wanted wanted{name, expression, std::nullopt};
        if (group != nullptr) wanted.group = group;
        compiler->aovs.push_back(std::move(wanted));
        return static_cast<uint32_t>(compiler->aovs.size() - 1);
    } catch (...) {
        return LIGHTSIEVE_NONE;
    }
}

uint32_t lightsieve_add_event(lightsieve_compiler* compiler, const lightsieve_event* event) {
    if (compiler == nullptr || event == nullptr) return LIGHTSIEVE_NONE;
    try {
        std::optional<Event> made = engine_event(*event);
        if (!made) return LIGHTSIEVE_NONE;
        compiler->events.push_back(*std::move(made));
        return static_cast<uint32_t>(compiler->events.size() - 1);
    } catch (...) {
        return LIGHTSIEVE_NONE;
    }
}

void lightsieve_set_standard(lightsieve_compiler* compiler, int standard) {
    if (compiler != nullptr) compiler->standard = standard != 0;
}

lightsieve_program* lightsieve_compile(lightsieve_compiler* compiler) {
    if (compiler == nullptr) return nullptr;
    try {
        compiler->reports.clear();
        Diagnostics diagnostics;
        std::vector<lpe::AovRequest> requests;
        for (const Wanted& wanted : compiler->aovs)
            requests.push_back(request_of(wanted, compiler->standard, diagnostics));
        const auto compiled = [&] {
            return embed::flatten(
                lpe::Program::compile(requests, compiler->events, {}, diagnostics),
                compiler->events);
        };
        std::optional<embed::FlatTables> flat = compiled();
        if (!flat) {
            // Each automaton was within its budget, but not all of them together: all black.
            diagnostics.error(Code::LimitLpeTable, "the AOVs together need too large a table", {},
                              "ask for fewer AOVs at once");
            for (lpe::AovRequest& request : requests)
                request.expr = nullptr;
            flat = compiled();
        }
        auto program = std::make_unique<lightsieve_program>(
            lightsieve_program{*std::move(flat), static_cast<uint32_t>(compiler->aovs.size())});
        for (const Error& error : diagnostics.items())
            compiler->reports.push_back(report_of(error));
        return program.release();
    } catch (...) {
        return nullptr;
    }
}

void lightsieve_program_destroy(lightsieve_program* program) { delete program; }

size_t lightsieve_n_diagnostics(const lightsieve_compiler* compiler) {
    return compiler == nullptr ? 0 : compiler->reports.size();
}

int lightsieve_get_diagnostic(const lightsieve_compiler* compiler, size_t i,
                              lightsieve_diagnostic* out) {
    if (compiler == nullptr || out == nullptr || i >= compiler->reports.size()) return 0;
    const Report& report = compiler->reports[i];
    *out = {static_cast<lightsieve_severity>(report.severity),
            report.code.c_str(),
            report.message.c_str(),
            report.hint.c_str(),
            report.expression.c_str(),
            report.column,
            report.text.c_str()};
    return 1;
}

lightsieve_tables lightsieve_program_tables(const lightsieve_program* program) {
    const embed::FlatTables& flat = program->flat;
    const auto count = [](const auto& array) { return static_cast<uint32_t>(array.size()); };
    return {flat.table.data(),
            count(flat.table) / flat.stride,
            flat.stride,
            lpe::Program::kFirstClass,
            flat.first_terminal,
            flat.starts.data(),
            count(flat.starts),
            flat.event_columns.data(),
            count(flat.event_columns),
            flat.atom_begin.data(),
            flat.atom_aovs.data(),
            count(flat.atom_begin) - 1,
            program->n_aovs};
}

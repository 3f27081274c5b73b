#include "python/errors.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "python/text.h"

namespace nb = nanobind;

namespace lightsieve::python {
namespace {

std::string_view severity_text(Severity severity) {
    switch (severity) {
        case Severity::Lint: return "lint";
        case Severity::Warning: return "warning";
        case Severity::Error: break;
    }
    return "error";
}

/// File, line and column, or three times None.
nb::tuple place(const SourceSpan& where) {
    if (!where.known()) return nb::make_tuple(nb::none(), nb::none(), nb::none());
    const LineColumn at = where.line_column();
    return nb::make_tuple(where.source->name, at.line, at.column);
}

/// A bug has been reported on standard error by whoever raised the signal, or could not be.
void exit_3(int signal) {
    // A broken assertion (SIGABRT) has said more than this already.
    constexpr std::string_view kCrash =
        "lightsieve: bug: the program crashed\nplease report this with the scene or the "
        "expression that caused it\n";
    if (signal != SIGABRT) [[maybe_unused]]
        const ssize_t written = write(STDERR_FILENO, kCrash.data(), kCrash.size());
    _exit(3);
}

}  // namespace

nb::object to_python(const Error& error) {
    const nb::module_ errors = nb::module_::import_("lightsieve.errors");
    nb::list notes;
    for (const Note& note : error.notes) {
        const nb::tuple at = place(note.where);
        notes.append(errors.attr("Note")(note.message, at[0], at[1], at[2]));
    }
    const nb::tuple at = place(error.where);
    return errors.attr("Diagnostic")(severity_text(error.severity), code_text(error.code),
                                     error.message, error.hint, at[0], at[1], at[2],
                                     error.render(), nb::tuple(notes));
}

nb::tuple to_python(const std::vector<Error>& errors) {
    nb::list out;
    for (const Error& error : errors)
        out.append(to_python(error));
    return nb::tuple(out);
}

void translate_errors() {
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const InputError& input) {
            const nb::object type =
                nb::module_::import_("lightsieve.errors").attr("LightsieveError");
            PyErr_SetObject(type.ptr(), type(to_python(input.errors())).ptr());
        }
    });
}

void add_common(nb::module_& module) {
    module.attr("version") = LIGHTSIEVE_VERSION;
    module.def(
        "exit_3_on_bug",
        [] {
            for (int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
                std::signal(signal, exit_3);
        },
        "Makes a crash or a broken assertion end the process with exit code 3. For programs, not "
        "for libraries.");
}

}  // namespace lightsieve::python

#include "core/diagnostics.h"

#include <algorithm>
#include <cctype>

namespace lightsieve {
namespace {

bool same_report(const Error& a, const Error& b) {
    return a.code == b.code && a.message == b.message && a.where.source == b.where.source &&
           a.where.offset == b.where.offset;
}

/// Levenshtein distance with transpositions, ignoring case; stops at `limit`.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    if ((a.size() > b.size() ? a.size() - b.size() : b.size() - a.size()) > limit)
        return limit + 1;
    std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        next[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
            next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + change});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) next[j] = std::min(next[j], before[j - 2] + 1);
        }
        std::swap(before, row);
        std::swap(row, next);
    }
    return row[b.size()];
}

}  // namespace

void Diagnostics::add(Error error) {
    const std::lock_guard lock(mutex_);
    const bool known = std::any_of(items_.begin(), items_.end(),
                                   [&](const Error& e) { return same_report(e, error); });
    if (known) return;
    std::size_t& count = error.severity == Severity::Error     ? n_errors_
                         : error.severity == Severity::Warning ? n_warnings_
                                                               : n_lints_;
    ++count;
    const std::size_t limit = error.severity == Severity::Error ? kMaxErrors : kMaxWarnings;
    if (count <= limit) items_.push_back(std::move(error));
}

void Diagnostics::add(const InputError& thrown, const SourceSpan& otherwise) {
    for (Error error : thrown.errors()) {
        if (!error.where.known()) error.where = otherwise;
        add(std::move(error));
    }
}

void Diagnostics::error(Code code, std::string message, SourceSpan where, std::string hint) {
    add({code, std::move(message), std::move(where), std::move(hint), {}, Severity::Error});
}
void Diagnostics::warning(Code code, std::string message, SourceSpan where, std::string hint) {
    add({code, std::move(message), std::move(where), std::move(hint), {}, Severity::Warning});
}
void Diagnostics::lint(Code code, std::string message, SourceSpan where, std::string hint) {
    add({code, std::move(message), std::move(where), std::move(hint), {}, Severity::Lint});
}

std::string Diagnostics::render() const {
    std::string out;
    for (const Error& e : items_)
        out += e.render() + "\n";
    const std::size_t total = n_errors_ + n_warnings_ + n_lints_;
    if (total > items_.size()) out += std::to_string(total - items_.size()) + " more not shown\n";
    return out;
}

void Diagnostics::throw_if_errors() const {
    if (!has_errors()) return;
    std::vector<Error> errors;
    std::copy_if(items_.begin(), items_.end(), std::back_inserter(errors),
                 [](const Error& e) { return e.severity == Severity::Error; });
    throw InputError(std::move(errors));
}

std::vector<std::string> nearest_names(std::string_view word,
                                       const std::vector<std::string>& candidates, std::size_t n) {
    const std::size_t limit = std::max<std::size_t>(1, word.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> found;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate, limit);
        if (distance <= limit) found.emplace_back(distance, candidate);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::vector<std::string> out;
    for (std::size_t i = 0; i < std::min(n, found.size()); ++i)
        out.push_back(found[i].second);
    return out;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    const std::vector<std::string> names = nearest_names(word, candidates);
    if (names.empty()) return "";
    std::string out = "did you mean ";
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) out += i + 1 == names.size() ? " or " : ", ";
        out += '"' + names[i] + '"';
    }
    return out + "?";
}

}  // namespace lightsieve

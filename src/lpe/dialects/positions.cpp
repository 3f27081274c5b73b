#include "lpe/dialects/positions.h"

#include <algorithm>

namespace lightsieve::lpe::dialects {
namespace {

/// What may stand first and last in a part.
struct Ends {
    std::vector<std::uint32_t> first, last;
    bool nullable = false;
};

void append(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

class Builder {
  public:
    explicit Builder(const Limits& limits) : limits_(limits) {}

    Positions run(const Pattern& pattern) {
        const Ends ends = add(pattern);
        out_.first = ends.first;
        out_.nullable = ends.nullable;
        out_.is_last.assign(out_.node.size(), false);
        for (const std::uint32_t position : ends.last)
            out_.is_last[position] = true;
        for (std::vector<std::uint32_t>& next : out_.follow) {
            std::ranges::sort(next);
            next.erase(std::unique(next.begin(), next.end()), next.end());
        }
        return std::move(out_);
    }

  private:
    Ends add(const Pattern& pattern) {
        switch (pattern.form) {
            case Pattern::Form::Event: return add_event(pattern);
            case Pattern::Form::Sequence: {
                Ends ends{{}, {}, true};
                for (const PatternPtr& part : pattern.parts)
                    ends = then(std::move(ends), add(*part));
                return ends;
            }
            case Pattern::Form::Alternation: {
                Ends ends;
                for (const PatternPtr& part : pattern.parts) {
                    const Ends more = add(*part);
                    append(ends.first, more.first);
                    append(ends.last, more.last);
                    ends.nullable = ends.nullable || more.nullable;
                }
                return ends;
            }
            case Pattern::Form::Repeat: return add_repeat(pattern);
            case Pattern::Form::Empty: return {{}, {}, true};
            default: return {};
        }
    }

    Ends add_event(const Pattern& pattern) {
        const auto position = static_cast<std::uint32_t>(out_.node.size());
        out_.node.push_back(&pattern);
        out_.follow.emplace_back();
        count(1);
        return {{position}, {position}, false};
    }

    Ends add_repeat(const Pattern& pattern) {
        const bool unbounded = pattern.max == Pattern::kUnbounded;
        const std::uint32_t n_copies = unbounded ? std::max(pattern.min, 1U) : pattern.max;
        Ends ends{{}, {}, true};
        for (std::uint32_t i = 0; i < n_copies; ++i) {
            Ends copy = add(*pattern.parts[0]);
            if (unbounded && i + 1 == n_copies) connect(copy.last, copy.first);
            copy.nullable = copy.nullable || i >= pattern.min;
            ends = then(std::move(ends), copy);
        }
        return ends;
    }

    void connect(const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
        for (const std::uint32_t position : from) {
            count(to.size());
            append(out_.follow[position], to);
        }
    }

    Ends then(Ends a, const Ends& b) {
        connect(a.last, b.first);
        if (a.nullable) append(a.first, b.first);
        if (b.nullable)
            append(a.last, b.last);
        else
            a.last = b.last;
        a.nullable = a.nullable && b.nullable;
        count(1);
        return a;
    }

    void count(std::size_t n) {
        n_nodes_ += n;
        if (n_nodes_ > limits_.max_nodes)
            throw OverBudget{Code::LimitLpeNodes,
                             "needs more than " + std::to_string(limits_.max_nodes) +
                                 " nodes of derived expressions",
                             "max_nodes"};
    }

    const Limits& limits_;
    Positions out_;
    std::size_t n_nodes_ = 0;
};

}  // namespace

Positions positions_of(const Pattern& pattern, const Limits& limits) {
    return Builder(limits).run(pattern);
}

}  // namespace lightsieve::lpe::dialects

#include "lpe/match.h"

#include "lpe/alphabet.h"
#include "lpe/term.h"

namespace lightsieve::lpe {

bool match(const Expr& expr, std::span<const Event> path, const Limits& limits) {
    if (!expr || !is_path(path)) return false;
    try {
        // The alphabet is that of the path's own events; events[0] is the camera.
        const std::span<const Event> events = path.subspan(1);
        const Alphabet alphabet({&expr, 1}, events);
        TermPool pool(alphabet, limits);
        TermId state = pool.derive(pool.lower(expr), Alphabet::kCamera);
        for (std::size_t i = 0; i < events.size(); ++i)
            state = pool.derive(state, alphabet.class_of(i));
        return pool.accepts_empty(state);
    } catch (const OverBudget& over) {
        throw InputError(over.error("the expression", expr->where));
    }
}

}  // namespace lightsieve::lpe

// The bodies that a path is inside of, in the order in which it entered them, and what they are filled with.
//
// A body is known by its shader, since one body may be made of several shapes. A path enters it when it is refracted at
// the outside of its surface and leaves it at the inside. Bodies may overlap: water reaches into the wall of its glass, so
// that no gap is left between them. There the body of higher priority is: its index of refraction and its medium count,
// surfaces of the others are not there. Bodies of equal priority know nothing of one another: their surfaces border on
// what else is there, or on air. So surfaces that do not close, which paths enter and never leave, do no harm by default.
// Source: Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images".
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "bsdf/closure.h"
#include "render/media_path.h"

namespace lightsieve {

class Interiors {
  public:
    Interiors() = default;
    ~Interiors() = default;
    // Only what is there is copied: paths are mostly inside of nothing.
    Interiors(const Interiors& other) { *this = other; }
    Interiors& operator=(const Interiors& other) {
        if (this == &other) return *this;
        n_ = other.n_;
        std::copy_n(other.bodies_.begin(), n_, bodies_.begin());
        return *this;
    }
    void clear() { n_ = 0; }
    /// body  the shader of the surface that the path went through to the inside
    /// object  whose surface it is: its lights shine on what the body is filled with
    /// More than fit are not kept: the path is as if outside of them.
    void enter(const void* body, const Interior& interior, const SceneObject* object = nullptr) {
        if (n_ < bodies_.size()) bodies_[n_++] = {body, interior, object};
    }
    /// The path went through such a surface to the outside. Bodies may overlap, so it need not be the last.
    void leave(const void* body) {
        for (std::size_t i = n_; i-- > 0;) {
            if (bodies_[i].body != body) continue;
            for (--n_; i < n_; ++i)
                bodies_[i] = bodies_[i + 1];
            return;
        }
    }
    /// Enters or leaves.
    void cross(const void* body, const Interior& interior, bool entering,
               const SceneObject* object = nullptr) {
        if (entering)
            enter(body, interior, object);
        else
            leave(body);
    }
    [[nodiscard]] bool empty() const { return n_ == 0; }
    /// The body that is there, of equals the one that was entered last; null: air.
    [[nodiscard]] const Interior* here() const {
        return interior_of(best([](const Body&) { return true; }));
    }
    /// The same, if its medium scatters.
    [[nodiscard]] std::optional<BodyMedium> scattering() const {
        const Body* body = best([](const Body&) { return true; });
        if (body == nullptr || !body->interior.medium.scatters()) return std::nullopt;
        return BodyMedium{body->interior.medium, body->object};
    }
    /// What a surface of `body` borders on; null: air.
    [[nodiscard]] const Interior* around(const void* body, int priority) const {
        return interior_of(best(
            [&](const Body& b) { return b.body != body && b.interior.priority != priority; }));
    }
    /// Whether the surface of a body is not there, because it lies in another one that wins.
    [[nodiscard]] bool hides(const void* body, const Interior& interior) const {
        const Interior* other = around(body, interior.priority);
        return other != nullptr && other->priority > interior.priority;
    }

  private:
    struct Body {
        const void* body = nullptr;
        Interior interior;
        const SceneObject* object = nullptr;
    };
    [[nodiscard]] static const Interior* interior_of(const Body* body) {
        return body == nullptr ? nullptr : &body->interior;
    }
    /// The one of highest priority among those that `counts` says; null if there is none.
    template <class Counts>
    [[nodiscard]] const Body* best(const Counts& counts) const {
        const Body* found = nullptr;
        for (std::size_t i = 0; i < n_; ++i)
            if (counts(bodies_[i]) &&
                (found == nullptr || bodies_[i].interior.priority >= found->interior.priority))
                found = &bodies_[i];
        return found;
    }

    std::array<Body, 8> bodies_;
    std::size_t n_ = 0;
};

}  // namespace lightsieve

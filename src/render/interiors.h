// The bodies that a path is inside of, in the order in which it entered them, and what they are filled with.
//
// A body is known by its shader, since one body may be made of several shapes. A path enters it when it is refracted at
// the outside of its surface and leaves it at the inside. Bodies may overlap: water reaches into the wall of its glass, so
// that no gap is left between them. There the body of higher priority is, of equals the one that was entered last. Its
// index of refraction and its medium count; surfaces of the others are not there.
// Source: Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images".
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "bsdf/closure.h"
#include "render/media_path.h"

namespace lightsieve {

class Interiors {
  public:
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
    /// The body that is there; null: air.
    [[nodiscard]] const Interior* here() const { return around(nullptr); }
    /// The same, if its medium scatters.
    [[nodiscard]] std::optional<BodyMedium> scattering() const {
        const std::size_t i = index_around(nullptr);
        if (i == n_ || !bodies_[i].interior.medium.scatters()) return std::nullopt;
        return BodyMedium{bodies_[i].interior.medium, bodies_[i].object};
    }
    /// The one that is there beside `body`: what its surface borders on.
    [[nodiscard]] const Interior* around(const void* body) const {
        const std::size_t i = index_around(body);
        return i == n_ ? nullptr : &bodies_[i].interior;
    }
    /// Whether the surface of a body is not there, because it lies in another one that wins.
    [[nodiscard]] bool hides(const void* body, const Interior& interior, bool entering) const {
        const std::size_t i = index_around(body);
        if (i == n_) return false;
        if (bodies_[i].interior.priority != interior.priority)
            return bodies_[i].interior.priority > interior.priority;
        return !entering && i + 1 > entered(body);
    }

  private:
    struct Body {
        const void* body = nullptr;
        Interior interior;
        const SceneObject* object = nullptr;
    };
    [[nodiscard]] std::size_t index_around(const void* body) const {
        std::size_t best = n_;
        for (std::size_t i = 0; i < n_; ++i)
            if (bodies_[i].body != body &&
                (best == n_ || bodies_[i].interior.priority >= bodies_[best].interior.priority))
                best = i;
        return best;
    }
    /// How many bodies were entered until this one, itself included; 0: the path began in it.
    [[nodiscard]] std::size_t entered(const void* body) const {
        for (std::size_t i = n_; i-- > 0;)
            if (bodies_[i].body == body) return i + 1;
        return 0;
    }

    std::array<Body, 8> bodies_;
    std::size_t n_ = 0;
};

}  // namespace lightsieve

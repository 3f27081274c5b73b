// clip_geo: shapes that cut away what lies inside of them, for rays of every kind.
//
// Whether a point lies inside of a closed shape is found by counting how often a ray from it crosses the shape. Nothing is
// cut apart: a surface that a ray meets inside of a cutter is passed as if it were not there, and on the cutter itself the cut's
// face is shown where it lies inside of something that is cut. Volumes, subsurface walks and probes of shaders do not know of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/name.h"
#include "render/accel.h"
#include "render/scene_object.h"

namespace lightsieve {

struct Surface;  // render/surface.h

/// A shape that cuts.
struct Cutter {
    Name trace_set;         ///< empty: it cuts everything
    bool inclusive = true;  ///< it cuts what is in trace_set, or what is not
    bool has_face = false;  ///< the cut has a shader
    std::unique_ptr<Accel> boundary;

    [[nodiscard]] bool cuts(const SceneObject& object) const;
};

class Cutters {
  public:
    /// Makes shapes with clip_geo cutters, and marks all that they cut (SceneObject::is_cut). Object 0 of `objects` is object 0
    /// of the scene's Accel.
    void find(std::vector<SceneObject>& objects, const std::string& isa);
    [[nodiscard]] bool empty() const { return cutters_.empty(); }
    /// Whether a surface of a shape that is marked is there, and not cut away.
    ///
    /// accel    all shapes; objects: by their number there
    [[nodiscard]] bool is_there(const Surface& surface, const Accel& accel,
                                const std::vector<SceneObject>& objects) const;

  private:
    std::vector<Cutter> cutters_;
};

}  // namespace lightsieve

// options.ignore_*: renders without a part of what the scene says.
//
// A switch is an edit of the nodes that are concerned, made when the scene has been assembled: without depth of field every
// aperture_size is 0, without bump no shader drives a normal. So nothing else in the renderer knows of the switches, and they
// act on what procedurals hold, too. (But for ignore_motion_blur: when samples are taken is no part of a node.)
#pragma once

#include "scene/graph.h"

namespace lightsieve {

/// Does what the graph's options ask for. The graph is assembled.
void apply_switches(SceneGraph& graph, Diagnostics& diagnostics);

}  // namespace lightsieve

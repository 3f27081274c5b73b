// What an operator may do: choose nodes of the scene and change them, before anything is compiled.
//
// Operators stand in a graph of their own: options.operator (or procedural.operator) is the last of a chain, whose
// `inputs` come first. They act on the scene's nodes and, when a procedural's file has been read, on its nodes too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "scene/graph.h"

namespace lightsieve {

class OperatorContext {
  public:
    virtual ~OperatorContext() = default;
    [[nodiscard]] virtual Diagnostics& diagnostics() = 0;
    /// Place of a parameter of the operator.
    [[nodiscard]] virtual SourceSpan where(Name param) const = 0;

    /// Lets an input act first. Empty references and nodes that are no operators are passed over, the latter with a warning.
    virtual void cook(NodeRef input) = 0;
    /// Lets the operators of a file act: the one of that name, or those that no other one names as input.
    virtual void cook_file(std::string_view filename, Name target) = 0;
    /// The nodes that the operator's parameter `selection` chooses, in file order; none for an expression that cannot be
    /// read, which is reported once.
    [[nodiscard]] virtual std::vector<NodeInstance*> selected() = 0;
    /// Makes the operator's `selection` known as `#name` to operators that act later.
    virtual void define_collection(Name name) = 0;

    /// Does `PARAM=VALUE` (see assignment.h). False if the node has no such parameter; all else that is wrong is reported.
    virtual bool assign(NodeInstance& node, std::string_view assignment) = 0;
    /// Sets a parameter to a value written as in a scene file.
    virtual void set(NodeInstance& node, std::string_view param, std::string_view value) = 0;
    /// Takes nodes out of the scene, and every reference to them.
    virtual void disable(const std::vector<NodeInstance*>& nodes) = 0;
    /// Counts what a part of the operator met, over all files; parts that meet nothing are reported in the end.
    ///
    /// part      what is told, e.g. an assignment; empty: the operator as a whole
    /// known     names that the part could have meant
    virtual void met(std::string_view part, std::size_t n,
                     const std::vector<std::string>& known) = 0;
};

}  // namespace lightsieve

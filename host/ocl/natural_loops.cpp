// Natural loops of machine code, from the dominators that Boost.Graph finds.
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dominator_tree.hpp>
#include <map>

#include "host/ocl/machine_code.h"

namespace glintmark {
namespace {

// Control flow with one node per instruction, in their order; node 0 is the entry.
using FlowGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::bidirectionalS>;
using Node = FlowGraph::vertex_descriptor;
constexpr Node kEntry = 0;

FlowGraph makeFlowGraph(const std::vector<Instruction>& instructions) {
  const std::size_t n = instructions.size();
  FlowGraph graph(n);
  for (Node i = 0; i < n; ++i) {
    if (instructions[i].falls_through && i + 1 < n) boost::add_edge(i, i + 1, graph);
    const auto jump = instructions[i].jump_target;
    if (!jump || *jump < instructions.front().address) continue;
    // A jump may aim at padding that was left out: the instruction after it is meant.
    const auto target = std::ranges::lower_bound(instructions, *jump, {}, &Instruction::address);
    if (target != instructions.end())
      boost::add_edge(i, static_cast<Node>(target - instructions.begin()), graph);
  }
  return graph;
}

// Immediate dominators of the nodes that the entry reaches.
class Dominators {
 public:
  explicit Dominators(const FlowGraph& graph)
      : above_(boost::num_vertices(graph), boost::graph_traits<FlowGraph>::null_vertex()) {
    boost::lengauer_tarjan_dominator_tree(
        graph, kEntry,
        boost::make_iterator_property_map(above_.begin(), boost::get(boost::vertex_index, graph)));
    above_[kEntry] = kEntry;
  }

  bool reached(Node node) const {
    return above_[node] != boost::graph_traits<FlowGraph>::null_vertex();
  }
  bool dominates(Node above, Node node) const {
    while (node != above && node != kEntry) node = above_[node];
    return node == above;
  }

 private:
  std::vector<Node> above_;
};

// Adds to `body` what reaches `tail` without passing the loop's head, which is in `body` already.
void growBody(const FlowGraph& graph, const Dominators& dominators, Node tail,
              std::vector<bool>& body) {
  std::vector<Node> pending{tail};
  while (!pending.empty()) {
    const Node node = pending.back();
    pending.pop_back();
    if (body[node] || !dominators.reached(node)) continue;
    body[node] = true;
    for (const auto edge : boost::make_iterator_range(boost::in_edges(node, graph)))
      pending.push_back(boost::source(edge, graph));
  }
}

using LoopBodies = std::map<Node, std::vector<bool>>;  // by loop head

LoopBodies findBodies(const FlowGraph& graph) {
  const Dominators dominators(graph);
  LoopBodies bodies;
  for (const auto edge : boost::make_iterator_range(boost::edges(graph))) {
    const Node tail = boost::source(edge, graph), head = boost::target(edge, graph);
    if (!dominators.reached(tail) || !dominators.dominates(head, tail)) continue;
    std::vector<bool>& body = bodies[head];
    body.resize(boost::num_vertices(graph));
    body[head] = true;
    growBody(graph, dominators, tail, body);
  }
  return bodies;
}

}  // namespace

std::vector<LoopCounts> findLoops(const std::vector<Instruction>& instructions) {
  if (instructions.empty()) return {};
  const LoopBodies bodies = findBodies(makeFlowGraph(instructions));
  std::vector<LoopCounts> loops;
  for (const auto& [head, body] : bodies) {
    LoopCounts loop;
    for (std::size_t i = 0; i < instructions.size(); ++i) {
      loop.instructions += body[i];
      loop.vector_512 += body[i] && instructions[i].vector_512;
      loop.multiplies += body[i] && instructions[i].multiply;
      loop.calls += body[i] && instructions[i].call;
    }
    for (const auto& [other_head, other_body] : bodies) {
      if (other_head == head) continue;
      loop.depth += other_body[head];
      const auto other_size = static_cast<std::size_t>(std::ranges::count(other_body, true));
      if (body[other_head]) loop.longest_inner = std::max(loop.longest_inner, other_size);
    }
    loops.push_back(loop);
  }
  return loops;
}

}  // namespace glintmark

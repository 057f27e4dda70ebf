#include "host/ocl/machine_code.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace glintmark {
namespace {

// The hexadecimal number at the front of `text`, after blanks.
std::optional<std::uint64_t> leadingHex(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (parsed.ec != std::errc()) return std::nullopt;
  return value;
}

// Text from the mnemonic on, without the prefixes that compilers pad with.
std::string_view withoutPrefixes(std::string_view text) {
  for (bool found = true; found;) {
    found = false;
    for (const std::string_view prefix : {"data16 ", "cs ", "ds "}) {
      if (!text.starts_with(prefix)) continue;
      text.remove_prefix(prefix.size());
      found = true;
    }
  }
  return text;
}

// "    10b6:\tje     1221 <...>"; nothing for padding and for lines that are no instruction.
std::optional<Instruction> parseLine(const std::string& line) {
  const std::size_t tab = line.find(":\t");
  const std::optional<std::uint64_t> address = leadingHex(line);
  if (tab == std::string::npos || !address) return std::nullopt;
  const std::string_view text = withoutPrefixes(std::string_view(line).substr(tab + 2));
  if (text.starts_with("nop") || text.starts_with("xchg   %ax,%ax") || text.starts_with("int3"))
    return std::nullopt;

  Instruction instruction;
  instruction.address = *address;
  instruction.vector_512 = text.find("%zmm") != std::string_view::npos;
  instruction.multiply = text.starts_with("vpmulld") || text.starts_with("imul");
  instruction.call = text.starts_with("call");
  instruction.falls_through = !text.starts_with("jmp") && !text.starts_with("ret");
  // Every x86 mnemonic that starts with j is a jump; indirect ones have no number here.
  if (text.starts_with("j"))
    instruction.jump_target = leadingHex(text.substr(std::min(text.find(' '), text.size())));
  return instruction;
}

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// Control flow with one node per instruction.
struct FlowGraph {
  std::vector<std::vector<std::size_t>> successors, predecessors;
  std::vector<std::size_t> postorder;  // of the nodes that the entry reaches, the entry last
  std::vector<std::size_t> rank;       // position in postorder, kNone if not reached
};

void orderNodes(FlowGraph& graph) {
  std::vector<bool> seen(graph.successors.size());
  std::vector<std::pair<std::size_t, std::size_t>> stack{{0, 0}};  // node, next successor
  seen[0] = true;
  while (!stack.empty()) {
    const std::size_t node = stack.back().first;
    if (stack.back().second < graph.successors[node].size()) {
      const std::size_t child = graph.successors[node][stack.back().second++];
      if (!seen[child]) stack.push_back({child, 0});
      seen[child] = true;
    } else {
      graph.rank[node] = graph.postorder.size();
      graph.postorder.push_back(node);
      stack.pop_back();
    }
  }
}

FlowGraph makeFlowGraph(const std::vector<Instruction>& instructions) {
  const std::size_t n = instructions.size();
  FlowGraph graph;
  graph.successors.resize(n);
  graph.predecessors.resize(n);
  graph.rank.resize(n, kNone);
  std::map<std::uint64_t, std::size_t> nodes;
  for (std::size_t i = 0; i < n; ++i) nodes[instructions[i].address] = i;
  for (std::size_t i = 0; i < n; ++i) {
    if (instructions[i].falls_through && i + 1 < n) graph.successors[i].push_back(i + 1);
    const auto jump = instructions[i].jump_target;
    if (!jump || *jump < instructions.front().address) continue;
    // A jump may aim at padding that was left out: the instruction after it is meant.
    const auto target = nodes.lower_bound(*jump);
    if (target != nodes.end()) graph.successors[i].push_back(target->second);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (const std::size_t next : graph.successors[i]) graph.predecessors[next].push_back(i);
  orderNodes(graph);
  return graph;
}

// Immediate dominators: Cooper, Harvey and Kennedy 2001, "A Simple, Fast Dominance Algorithm".
std::vector<std::size_t> findDominators(const FlowGraph& graph) {
  std::vector<std::size_t> dominator(graph.successors.size(), kNone);
  dominator[0] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (auto node = graph.postorder.rbegin() + 1; node != graph.postorder.rend(); ++node) {
      std::size_t common = kNone;
      for (std::size_t other : graph.predecessors[*node]) {
        if (dominator[other] == kNone) continue;
        if (common == kNone) common = other;
        while (other != common) {
          std::size_t& later = graph.rank[other] < graph.rank[common] ? other : common;
          later = dominator[later];
        }
      }
      changed |= dominator[*node] != common;
      dominator[*node] = common;
    }
  }
  return dominator;
}

bool dominates(const std::vector<std::size_t>& dominator, std::size_t above, std::size_t node) {
  while (node != above && node != 0) node = dominator[node];
  return node == above;
}

// Adds to `body` what reaches `tail` without passing the loop's head, which is in `body` already.
void growBody(const FlowGraph& graph, std::size_t tail, std::vector<bool>& body) {
  std::vector<std::size_t> pending{tail};
  while (!pending.empty()) {
    const std::size_t node = pending.back();
    pending.pop_back();
    if (body[node] || graph.rank[node] == kNone) continue;
    body[node] = true;
    for (const std::size_t before : graph.predecessors[node]) pending.push_back(before);
  }
}

using LoopBodies = std::map<std::size_t, std::vector<bool>>;  // by loop head

LoopBodies findBodies(const FlowGraph& graph) {
  const std::vector<std::size_t> dominator = findDominators(graph);
  LoopBodies bodies;
  for (std::size_t tail = 0; tail < graph.successors.size(); ++tail) {
    if (graph.rank[tail] == kNone) continue;
    for (const std::size_t head : graph.successors[tail]) {
      if (!dominates(dominator, head, tail)) continue;
      std::vector<bool>& body = bodies[head];
      body.resize(graph.successors.size());
      body[head] = true;
      growBody(graph, tail, body);
    }
  }
  return bodies;
}

}  // namespace

std::vector<Instruction> parseFunction(const std::string& disassembly,
                                       const std::string& function) {
  std::istringstream lines(disassembly);
  const std::string header = "<" + function + ">:";
  std::string line;
  while (std::getline(lines, line) && !line.ends_with(header)) continue;
  std::vector<Instruction> instructions;
  while (std::getline(lines, line) && !line.empty())
    if (const auto instruction = parseLine(line)) instructions.push_back(*instruction);
  return instructions;
}

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

// What a rank that has measured a case tells the first.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "host/report/record/record.h"

namespace glintmark {

/// A case that was measured, or left out for want of time (no records); or a file of it.
struct CaseMessage {
  std::size_t index = 0;  // of the case
  std::vector<Record> records{};
  std::string file{}, content{};  // name in the folder of results; empty: it is a case
};

std::string packMessage(const CaseMessage& message);
/// Inverse of packMessage. Throws Error if it is not whole.
CaseMessage unpackMessage(const std::string& bytes);

/// Cases whose like are measured together, so that one rank should have them: those that differ in
/// the third word only, "disk/near/toksvig" and "disk/near/lean".
std::string caseGroup(const std::string& case_name);

/// Which of `ranks` measures each of `cases`: groups in turn.
std::vector<int> dealCases(const std::vector<std::string>& cases, const std::vector<int>& ranks);

}  // namespace glintmark

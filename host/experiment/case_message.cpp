#include "host/experiment/case_message.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "host/core/error.h"
#include "host/report/record/case_name.h"
#include "host/report/record/records.h"

namespace glintmark {
namespace {

constexpr std::size_t kGroupWords = 2;

}  // namespace

std::string packMessage(const CaseMessage& message) {
  std::string bytes =
      fmt::format("{} {} {}\n", message.index, message.records.size(), message.file);
  for (const Record& record : message.records) bytes += recordLine(record) + "\n";
  return bytes + message.content;
}

CaseMessage unpackMessage(const std::string& bytes) {
  std::istringstream stream(bytes);
  CaseMessage message;
  std::size_t count = 0;
  std::string line;
  std::getline(stream, line);
  std::istringstream head(line);
  if (!(head >> message.index >> count)) throw Error("a rank's message cannot be read");
  head >> message.file;
  for (; count > 0 && std::getline(stream, line); --count)
    message.records.push_back(parseRecordLine(line, "a rank's message").record);
  if (count > 0) throw Error("a rank's message is cut off");
  if (!message.file.empty())
    message.content = bytes.substr(static_cast<std::size_t>(stream.tellg()));
  return message;
}

std::string caseGroup(const std::string& case_name) {
  CaseName name = CaseName::parse(case_name);
  if (name.words.size() > kGroupWords) name.words.resize(kGroupWords);
  return name.text();
}

std::vector<int> dealCases(const std::vector<std::string>& cases, const std::vector<int>& ranks) {
  std::map<std::string, int> by_group;
  std::vector<int> dealt;
  dealt.reserve(cases.size());
  for (const std::string& one : cases) {
    const std::string group = caseGroup(one);
    const int next = ranks[by_group.size() % ranks.size()];
    dealt.push_back(by_group.emplace(group, next).first->second);
  }
  return dealt;
}

}  // namespace glintmark

#include "host/scene/toml_depth.h"

#include <fmt/format.h>

#include "host/core/error.h"

namespace glintmark {
namespace {

class DepthScanner {
 public:
  DepthScanner(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skipString(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      step(c);
      ++at_;
    }
  }

 private:
  void step(char c) {
    if (c == '\n') ++line_;
    if (c == '.') {
      if (++steps_ > kMostTomlDepth) fail("a key of more steps");
    } else if (c == '[' || c == '{') {
      if (++open_ > kMostTomlDepth) fail("more brackets in brackets");
    } else if ((c == ']' || c == '}') && open_ > 0) {
      --open_;
    }
    // A dotted key ends where its value or the next one begins.
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}')
      steps_ = 0;
  }

  void skipString(char quote) {
    const std::string three(3, quote);
    const bool long_one = text_.substr(at_, 3) == three;
    at_ += long_one ? 3 : 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\n') {
        if (!long_one) return;  // malformed: the parser says so
        ++line_;
      }
      if (c == '\\' && quote == '"') {
        at_ += 2;
        continue;
      }
      const bool end = long_one ? text_.substr(at_, 3) == three : c == quote;
      if (end) {
        at_ += long_one ? 3 : 1;
        return;
      }
      ++at_;
    }
  }

  [[noreturn]] void fail(const char* what) const {
    throw Error(fmt::format("{}:{}: has {} than the {} that are read", source_, line_, what,
                            kMostTomlDepth));
  }

  std::string_view text_;
  const std::string& source_;
  std::size_t at_ = 0;
  int line_ = 1, steps_ = 0, open_ = 0;
};

}  // namespace

void checkTomlDepth(std::string_view text, const std::string& source) {
  DepthScanner(text, source).run();
}

}  // namespace glintmark

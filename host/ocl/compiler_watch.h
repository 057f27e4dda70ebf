// Says on stderr that a driver's compiler takes long: nothing else shows that the program lives.
#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace glintmark {

/// As long as it lives, a driver compiles `what`. Notes are printed after kFirstNote and then each
/// time that the time has doubled, unless the program is to be quiet.
class CompilerWatch {
 public:
  explicit CompilerWatch(std::string what);
  ~CompilerWatch();
  CompilerWatch(const CompilerWatch&) = delete;
  CompilerWatch& operator=(const CompilerWatch&) = delete;

 private:
  void watch();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace glintmark

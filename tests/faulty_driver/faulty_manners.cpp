// What drivers do to the process that they are in; see fault_list.h.
#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/faulty_driver/fault_list.h"
#include "tests/faulty_driver/next_call.h"

namespace faulty {
namespace {

void* volatile nowhere = nullptr;

// Recursion without an end, which compilers must not see through.
int (*volatile deeper)(int) = nullptr;

int endless(int depth) {
  volatile char frame[1024];
  frame[0] = static_cast<char>(depth);
  return deeper(depth + 1) + frame[0];
}

void crash() {
  *static_cast<volatile int*>(nowhere) = 1;
}

void stall() {
  while (true) pause();
}

void exitNow() {
  exit(0);
}

void ignore(int) {}

void printSomething() {
  std::printf("driver: a word of mine\n");
  std::fflush(stdout);
}

struct Deed {
  const char* name;
  void (*act)();
};

constexpr Deed kDeeds[] = {
    {"crash", crash},
    {"abort", [] { abort(); }},
    {"exit0", exitNow},
    {"_exit0", [] { _exit(0); }},
    {"overflow", [] { deeper = endless, endless(0); }},
    {"throw", [] { throw 1; }},
    {"stall", stall},
    {"print", printSomething},
#ifdef __SSE2__
    {"flush_to_zero", [] { _mm_setcsr(_mm_getcsr() | 0x8040); }},
    {"traps", [] { feenableexcept(FE_DIVBYZERO | FE_INVALID); }},
#endif
    {"round_down", [] { fesetround(FE_DOWNWARD); }},
    {"locale", [] { setlocale(LC_ALL, "de_DE.UTF-8"); }},
    {"chdir", [] { [[maybe_unused]] const int moved = chdir("/"); }},
    {"umask", [] { umask(0777); }},
    {"keeps_interrupts",
     [] {
       signal(SIGINT, ignore);
       signal(SIGTERM, ignore);
     }},
    {"blocks_signals",
     [] {
       sigset_t all;
       sigfillset(&all);
       pthread_sigmask(SIG_BLOCK, &all, nullptr);
     }},
    {"ignores_children", [] { signal(SIGCHLD, SIG_IGN); }},
    {"default_pipe", [] { signal(SIGPIPE, SIG_DFL); }},
    {"closes_output", [] { close(1); }},
    {"closes_all",
     [] {
       for (int file = 0; file < 3; ++file) close(file);
     }},
    {"thread", [] { std::thread(stall).detach(); }},
    {"child",
     [] {
       if (fork() == 0) {
         sleep(20);
         _exit(0);
       }
     }},
    {"crash_at_exit", [] { atexit(crash); }},
    {"stall_at_exit", [] { atexit(stall); }},
    {"environment", [] { setenv("GLINTMARK_KERNELS", "/nowhere", 1); }},
};

}  // namespace

void die() {
  signal(SIGSEGV, SIG_DFL);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGSEGV);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  raise(SIGSEGV);
}

void misbehave(const char* when) {
  const auto wanted = valueOfPart("at", when);
  if (!wanted) return;
  for (const Deed& deed : kDeeds)
    if (*wanted == deed.name) deed.act();
}

}  // namespace faulty

using namespace faulty;

extern "C" {

cl_context clCreateContext(const cl_context_properties* properties, cl_uint count,
                           const cl_device_id* devices,
                           void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*),
                           void* user, cl_int* status) {
  misbehave("opening");
  return REAL(clCreateContext)(properties, count, devices, notify, user, status);
}

cl_int clReleaseContext(cl_context context) {
  misbehave("closing");
  return REAL(clReleaseContext)(context);
}

}  // extern "C"

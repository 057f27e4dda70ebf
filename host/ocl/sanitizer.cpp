// Linked into sanitizer builds only: memory that PoCL and the compiler in it keep until the end of
// the process is not ours to free.
extern "C" const char* __lsan_default_suppressions();

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libpocl\nleak:libLLVM\nleak:libclang\nleak:libOpenCL\n";
}

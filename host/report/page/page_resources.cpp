#include "host/report/page/page_resources.h"

// The assembler reads the files; CMakeLists.txt names them and rebuilds this when they change.
#define EMBED(symbol, file)                                                                     \
  __asm__(                                                                                      \
      ".pushsection .rodata\n"                                                                  \
      ".global " #symbol "_begin\n.global " #symbol "_end\n" #symbol "_begin:\n.incbin \"" file \
      "\"\n" #symbol "_end:\n.popsection\n");                                                   \
  extern "C" const char symbol##_begin[], symbol##_end[]

EMBED(glintmark_page_css, GLINTMARK_PAGE_CSS);
EMBED(glintmark_page_js, GLINTMARK_PAGE_JS);
EMBED(glintmark_chart_js, GLINTMARK_CHART_JS);

namespace glintmark {

std::string_view pageCss() {
  return {glintmark_page_css_begin, glintmark_page_css_end};
}
std::string_view pageJs() {
  return {glintmark_page_js_begin, glintmark_page_js_end};
}
std::string_view chartJs() {
  return {glintmark_chart_js_begin, glintmark_chart_js_end};
}

}  // namespace glintmark

#include "host/report/page/page_frame.h"

#include "host/report/page/html_text.h"
#include "host/report/page/page_resources.h"

namespace glintmark {

std::string pageHead(const std::string& title) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" "
      "href=\"data:,\">\n<title>" +
      escapeHtml(title) + "</title>\n<style>\n";
  html += pageCss();
  return html + "</style>\n</head>\n<body>\n";
}

std::string pageEnd(const std::string& records) {
  std::string end = "</main>\n<script type=\"application/json\" id=\"records\">" + records +
                    "</script>\n<script>\n";
  end += chartJs();
  end += "\n</script>\n<script>\n";
  end += pageJs();
  return end + "</script>\n</body>\n</html>\n";
}

}  // namespace glintmark

// Reads a result from standard input and writes its report to standard output.
#include <iostream>
#include <iterator>

#include "app/report/report.hpp"

int main() {
  const std::string result(std::istreambuf_iterator<char>(std::cin), {});
  std::cout << kinetix::app::report_html(result);
}

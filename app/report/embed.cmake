# Puts the page, its style and its scripts into one C++ string constant.
# cmake -DPAGE=... -DSTYLE=... "-DSCRIPTS=a.js;b.js" -DNAME=constant -DOUTPUT=... -P embed.cmake
set(js "(() => {\n\"use strict\";\n")
foreach(script IN LISTS SCRIPTS)
  file(READ ${script} text)
  string(REGEX REPLACE "\n +" "\n" text "\n${text}")  # indentation is an eighth of the script
  string(REGEX REPLACE "\n(//[^\n]*|/\\*\\*[^\n]*\\*/)" "" text "${text}")  # lines that are only a comment
  string(APPEND js "${text}\n")
endforeach()
string(APPEND js "})();")
cmake_path(REPLACE_EXTENSION OUTPUT LAST_ONLY js OUTPUT_VARIABLE script)
file(WRITE ${script} "${js}\n")  # for tests that read the page's script as a whole
file(READ ${STYLE} css)
file(READ ${PAGE} page)

foreach(text IN ITEMS css js page)
  string(FIND "${${text}}" ")kinetix\"" end_of_literal)
  if(NOT end_of_literal EQUAL -1)
    message(FATAL_ERROR "the report's ${text} holds the end of the C++ string literal")
  endif()
endforeach()
string(TOLOWER "${js}" lower)
string(FIND "${lower}" "</script" end_of_script)
if(NOT end_of_script EQUAL -1)
  message(FATAL_ERROR "the report's script would end its own element")
endif()

string(REPLACE "@REPORT_CSS@" "${css}" page "${page}")
string(REPLACE "@REPORT_JS@" "${js}" page "${page}")
file(WRITE ${OUTPUT} "#include \"app/report/report.hpp\"\n\nnamespace kinetix::app {\n\n"
  "const std::string_view ${NAME} = R\"kinetix(${page})kinetix\";\n\n}  // namespace kinetix::app\n")

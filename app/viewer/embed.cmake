# Writes a C++ source with the bundles as bytes, or with empty lists if the studio is off.
# cmake -DSTUDIO=ON|OFF -DBUNDLES=folder -DPAGE=studio.html -DOUTPUT=... -P embed.cmake

# bytes_of(file variable): sets the variable to the bytes of the file as hexadecimal numbers, which compile quickly and
# have no length limit.
function(bytes_of file variable)
  file(READ ${file} hex HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  set(${variable} "${bytes}" PARENT_SCOPE)
endfunction()

set(text "#include \"app/viewer/assets.hpp\"\n\nnamespace kinetix::app {\n")
if(STUDIO)
  string(APPEND text "namespace {\n\n")
  foreach(part IN ITEMS page:${PAGE} style:${BUNDLES}/studio.css script:${BUNDLES}/studio.js scene:${BUNDLES}/scene.js)
    string(REGEX MATCH "^([a-z]+):(.*)$" matched ${part})
    bytes_of(${CMAKE_MATCH_2} bytes)
    string(APPEND text "constexpr unsigned char ${CMAKE_MATCH_1}_bytes[] = {${bytes}};\n")
  endforeach()
  string(APPEND text [[

template <std::size_t size>
std::string_view text_of(const unsigned char (&bytes)[size]) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

std::span<const Asset> studio_assets() {
  static const Asset all[] = {{"/", "text/html; charset=utf-8", text_of(page_bytes)},
                              {"/studio.css", "text/css; charset=utf-8", text_of(style_bytes)},
                              {"/studio.js", "text/javascript; charset=utf-8", text_of(script_bytes)}};
  return all;
}

std::string_view scene_script() { return text_of(scene_bytes); }
]])
else()
  string(APPEND text "\nstd::span<const Asset> studio_assets() { return {}; }\nstd::string_view scene_script() { return {}; }\n")
endif()
string(APPEND text "\n}  // namespace kinetix::app\n")
file(WRITE ${OUTPUT} "${text}")

# Puts the parts of the report's page together and writes them as C++.
#   cmake -D FOLDER=data/report -D OUTPUT=report_template.cpp -P assemble.cmake
function(read_parts into)
  set(text "")
  foreach(part ${ARGN})
    file(READ ${FOLDER}/${part} content)
    string(APPEND text "${content}\n")
  endforeach()
  set(${into} "${text}" PARENT_SCOPE)
endfunction()

# How a Content-Security-Policy names a script that may run: 'sha256-' and base64 of its digest.
function(script_source into script)
  set(digits ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  string(SHA256 hex "${script}")
  set(text "")
  foreach(at RANGE 0 60 3)  # three hexadecimal digits are two of base64; 64 leave one over
    string(SUBSTRING "${hex}0000" ${at} 3 three)
    math(EXPR high "0x${three} >> 6")
    math(EXPR low "0x${three} & 63")
    string(SUBSTRING ${digits} ${high} 1 high)
    string(SUBSTRING ${digits} ${low} 1 low)
    string(APPEND text ${high}${low})
  endforeach()
  string(SUBSTRING "${hex}00" 63 3 three)
  math(EXPR high "0x${three} >> 6")
  string(SUBSTRING ${digits} ${high} 1 high)
  set(${into} "'sha256-${text}${high}='" PARENT_SCOPE)
endfunction()

# Puts head, style and script into a page, whose policy lets that script run and no other. `sources`:
# what else it may load.
file(READ ${FOLDER}/head.html HEAD)
macro(fill_page page title sources)
  string(REPLACE "<!--HEAD-->\n" "${HEAD}" ${page} "${${page}}")
  string(REPLACE "PAGE-TITLE" "${title}" ${page} "${${page}}")
  string(REPLACE "MORE-SOURCES" "${sources}" ${page} "${${page}}")
  string(REPLACE "<!--STYLE-->\n" "${STYLE}" ${page} "${${page}}")
  string(REPLACE "<!--SCRIPT-->\n" "${SCRIPT}" ${page} "${${page}}")
  script_source(SOURCE "\n${SCRIPT}")
  string(REPLACE "SCRIPT-SOURCE" "${SOURCE}" ${page} "${${page}}")
endmacro()

read_parts(STYLE libraries/uplot.min.css style.css)
read_parts(SCRIPT libraries/uplot.min.js libraries/ogl.min.js elements.js data.js follow.js player.js space.js chart.js charts.js tables.js main.js)
file(READ ${FOLDER}/page.html PAGE)
file(READ ${FOLDER}/normal_gait.csv NORMAL_GAIT)
fill_page(PAGE "<!--TITLE-->" "; img-src data: blob:; media-src blob: file: 'self'")

read_parts(SCRIPT batch.js)
read_parts(STYLE style.css)
file(READ ${FOLDER}/batch.html BATCH)
fill_page(BATCH "walktrack batch" "")

read_parts(SCRIPT libraries/uplot.min.js elements.js chart.js compare.js)
read_parts(STYLE libraries/uplot.min.css style.css)
file(READ ${FOLDER}/compare.html COMPARE)
fill_page(COMPARE "<!--TITLE-->" "")

file(WRITE ${OUTPUT} "// Made from data/report by assemble.cmake.
#include \"io/drawing/report_page.h\"

namespace walktrack {
inline namespace io {

std::string_view report_template() {
  static constexpr char kText[] = R\"template(${PAGE})template\";
  return {kText, sizeof(kText) - 1};
}

std::string_view batch_template() {
  static constexpr char kText[] = R\"template(${BATCH})template\";
  return {kText, sizeof(kText) - 1};
}

std::string_view compare_template() {
  static constexpr char kText[] = R\"template(${COMPARE})template\";
  return {kText, sizeof(kText) - 1};
}

std::string_view normal_gait_csv() {
  static constexpr char kText[] = R\"csv(${NORMAL_GAIT})csv\";
  return {kText, sizeof(kText) - 1};
}

}  // namespace io
}  // namespace walktrack
")

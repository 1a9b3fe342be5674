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

read_parts(STYLE libraries/uplot.min.css style.css)
read_parts(SCRIPT libraries/uplot.min.js libraries/ogl.min.js elements.js data.js player.js space.js chart.js charts.js tables.js main.js)
file(READ ${FOLDER}/page.html PAGE)
file(READ ${FOLDER}/normal_gait.csv NORMAL_GAIT)
string(REPLACE "<!--STYLE-->\n" "${STYLE}" PAGE "${PAGE}")
string(REPLACE "<!--SCRIPT-->\n" "${SCRIPT}" PAGE "${PAGE}")

read_parts(SCRIPT batch.js)
read_parts(STYLE style.css)
file(READ ${FOLDER}/batch.html BATCH)
string(REPLACE "<!--STYLE-->\n" "${STYLE}" BATCH "${BATCH}")
string(REPLACE "<!--SCRIPT-->\n" "${SCRIPT}" BATCH "${BATCH}")

read_parts(SCRIPT libraries/uplot.min.js elements.js chart.js compare.js)
read_parts(STYLE libraries/uplot.min.css style.css)
file(READ ${FOLDER}/compare.html COMPARE)
string(REPLACE "<!--STYLE-->\n" "${STYLE}" COMPARE "${COMPARE}")
string(REPLACE "<!--SCRIPT-->\n" "${SCRIPT}" COMPARE "${COMPARE}")

file(WRITE ${OUTPUT} "// Made from data/report by assemble.cmake.
#include \"io/drawing/report_page.h\"

namespace walktrack {

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

}  // namespace walktrack
")

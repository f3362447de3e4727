# The page of reports as one file, share/articular/report/page.html: scripts of this folder and the packages that
# package-lock.json names, which npm fetches. Without node and npm there is no page, and `articular report` says so.
find_program(ARTICULAR_NODE node)
find_program(ARTICULAR_NPM npm)
mark_as_advanced(ARTICULAR_NODE ARTICULAR_NPM)
if(ARTICULAR_NODE AND ARTICULAR_NPM)
  set(page_folder ${CMAKE_CURRENT_LIST_DIR})
  set(packages ${CMAKE_BINARY_DIR}/report-page)
  set(page ${CMAKE_BINARY_DIR}/share/articular/report/page.html)
  file(GLOB page_sources CONFIGURE_DEPENDS ${page_folder}/*.js ${page_folder}/*.css ${page_folder}/*.html)
  add_custom_command(OUTPUT ${page}
    COMMAND ${page_folder}/make-page ${packages} ${page} ${ARTICULAR_NPM} ${ARTICULAR_NODE}
    DEPENDS ${page_sources} ${page_folder}/make-page ${page_folder}/bundle.mjs ${page_folder}/package-lock.json
    COMMENT "Making the page of reports" VERBATIM)
  add_custom_target(articular_report_page ALL DEPENDS ${page})
else()
  message(STATUS "articular report: no node or no npm here, so this build makes no pages")
endif()

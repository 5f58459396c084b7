# The documentation as a site: cmake --build --preset release --target site
# Nothing else needs its packages, so that ./check does not install them. They are looked for when the target is built:
# once they are installed, nothing has to be configured again.
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/apt-packages-site.txt site_packages)
list(JOIN site_packages " " site_packages)
set(site ${PROJECT_BINARY_DIR}/site)
add_custom_target(site
  COMMAND sh -c "{ command -v doxygen && /usr/bin/python3 -c 'import breathe, furo, myst_parser, sphinx' ; } \
    >/dev/null 2>&1 || { echo 'The site needs: apt-get install -y --no-install-recommends ${site_packages}'; exit 1; }"
  # From nothing: what is kept would show old lists of pages, and would not warn again. rm does not follow links.
  COMMAND rm -rf ${site}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${site}/source/api
  # A broken link is a warning, and warnings (-W) are errors.
  COMMAND /usr/bin/python3 -B -m sphinx -q -W --keep-going -j 1 -b html -c ${PROJECT_SOURCE_DIR}/docs/site
    -d ${site}/doctrees -D release=${PROJECT_VERSION} -D breathe_projects.tunica=${site}/doxygen
    ${site}/source ${site}/html
  COMMAND ${CMAKE_COMMAND} -E echo "The site is in ${site}/html/index.html"
  USES_TERMINAL VERBATIM COMMENT "Documentation site")

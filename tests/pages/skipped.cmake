# The test of pages where chromium or node is missing.
if(DEFINED ENV{BARYCERT_PAGES_REQUIRED})
  message(FATAL_ERROR "chromium or node is missing: configure again once they are installed")
endif()
message("skipped: chromium or node is missing, see ./run pages")

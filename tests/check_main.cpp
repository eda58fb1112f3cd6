// check_main.cpp - main of a test program.
#include "check.h"

int main(int argc, char** argv) {
  return bsm::test::run_cases(argc, argv);
}

// sloppy.cpp - compiles under -Werror only while no warning is turned on: each line names the option that refuses it.
#include <bsm/bsm.h>

static int unused_function() {  // -Wall
  return bsm_cpu_features() != 0;
}

int sloppy(long parameter, int unused) {  // -Wextra
  int copy = parameter;                   // -Wconversion
  {
    int copy = 1;  // -Wshadow
    (void)copy;
  }
  int array[0];  // -Wpedantic
  return copy + static_cast<int>(sizeof array);
}

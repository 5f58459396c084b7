// Writes meshes/quarter-tube.h5: verify-quarter-tube FILE
#include <iostream>

#include "quarter_tube.hpp"
#include "tunica/mesh/write.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "verify-quarter-tube FILE\n";
    return 1;
  }
  tunica::mesh::write(tunica::verify::make_quarter_tube(2), argv[1]);
  return 0;
}

#include "cli/app.h"

int main(int argc, char** argv) {
  return rnmbake::run(argc, argv);
}

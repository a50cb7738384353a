#include <iostream>
#include <string>
#include <vector>

#include <unistd.h>

#include "sluice/client/command_line.h"

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  return sluice::client::runCommandLine(arguments, {std::cout, std::cerr, terminal});
}

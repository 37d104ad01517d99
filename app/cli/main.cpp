#include "app/cli/commands.hpp"

int main(int argc, char** argv) { return kinetix::app::run_command_line(argc, argv); }

#include "app/cli/commands.h"

int main(int argc, char** argv) { return ergodome::run_program(argc, argv); }

// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

int main(int argc, char** argv) { return bdpt_tool::run_program(argc, argv); }

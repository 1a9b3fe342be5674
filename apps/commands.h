// The commands, one apps/cmd_<name>.cpp each. main.cpp lists them with their summaries.
#pragma once

#include "command.h"

namespace walktrack {

int run_analyse(const Arguments& arguments);
int run_batch(const Arguments& arguments);
int run_calibrate(const Arguments& arguments);
int run_check(const Arguments& arguments);
int run_compare(const Arguments& arguments);
int run_config(const Arguments& arguments);
int run_cycle(const Arguments& arguments);
int run_evaluate(const Arguments& arguments);
int run_init(const Arguments& arguments);
int run_optimise(const Arguments& arguments);
int run_plan(const Arguments& arguments);
int run_prior(const Arguments& arguments);
int run_render(const Arguments& arguments);
int run_selftest(const Arguments& arguments);
int run_simulate(const Arguments& arguments);
int run_sweep(const Arguments& arguments);
int run_track(const Arguments& arguments);

}  // namespace walktrack

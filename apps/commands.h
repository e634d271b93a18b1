#pragma once

#include "apps/arguments.h"

#include <span>

namespace scree::apps {

/// One word after `scree`.
struct Command {
    CommandWords words;
    void (*run)(Arguments& arguments) = nullptr;
};

/// All commands, in the order in which they are listed.
std::span<const Command> commands();

void run_rocks(Arguments& arguments);
void run_mesh(Arguments& arguments);
void run_scatter(Arguments& arguments);
void run_procedural(Arguments& arguments);
void run_describe(Arguments& arguments);
void run_erode(Arguments& arguments);
void run_weather(Arguments& arguments);
void run_terrain(Arguments& arguments);
void run_render(Arguments& arguments);
void run_score(Arguments& arguments);
void run_check(Arguments& arguments);
void run_deform(Arguments& arguments);
void run_classify(Arguments& arguments);

}  // namespace scree::apps

// Prints how many frames the filtered picture needs to follow a change: the table of tests/image/motion, over
// a larger picture. `bench_step_response [WIDTH HEIGHT]`.
#include "tests/image/motion/step_response.h"

#include <cstdlib>
#include <exception>
#include <fmt/format.h>

int main(int argc, char** argv) {
    kilolux::test::StepOptions options;
    options.width = argc > 2 ? std::atoi(argv[1]) : 320;
    options.height = argc > 2 ? std::atoi(argv[2]) : 180;
    options.framesBefore = 64;
    options.framesAfter = 32;
    if (options.width < 8 || options.height < 8) {
        fmt::print(stderr, "bench_step_response: WIDTH and HEIGHT are pixels, at least 8\n");
        return 2;
    }
    try {
        fmt::print("{} x {} pixels, one ray each\n{}", options.width, options.height,
                   kilolux::test::stepTable(kilolux::test::measureStepResponses(options)));
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_step_response: {}\n", error.what());
        return 3;
    }
}

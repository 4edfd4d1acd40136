// ltc_fit OUT.bin [SIZE]: fits GGX by linearly transformed cosines and writes the table (ltc_table.h).
#include "content/make/ltc_fit.h"

#include <cstdio>
#include <cstdlib>
#include <thread>

int main(int argc, char** argv) {
    const int size = argc > 2 ? std::atoi(argv[2]) : 64;
    if (argc < 2 || size < 2 || size > 1024) {
        std::fprintf(stderr, "usage: ltc_fit OUT.bin [SIZE 2..1024]\n");
        return 2;
    }
    const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const kilolux::LtcTable table = kilolux::fitLtcTable(size, size, threads);
    const auto saved = kilolux::saveLtcTable(table, argv[1]);
    if (!saved) {
        std::fprintf(stderr, "%s\n", saved.error().c_str());
        return 3;
    }
    std::printf("wrote '%s', %d x %d nodes\n", argv[1], size, size);
    return 0;
}

// Prints, as markdown, how accurate a voxelization is: its coverage, leaf fits and volume are
// compared with the geometry's own definition.

#include "tables.h"

#include <cstdio>
#include <cstring>

namespace {

struct Table {
    const char* name;
    void (*print)();
};

constexpr Table kTables[] = {{"isolated", heddle::bench::print_isolated_fibers},
                             {"bundles", heddle::bench::print_bundles},
                             {"leaf", heddle::bench::print_leaf_fits},
                             {"volume", heddle::bench::print_volumes}};

} // namespace

/// Prints the tables that are named on the command line, or all.
int main(int argc, char** argv) {
    int printed = 0;
    for (const Table& table : kTables) {
        bool wanted = argc == 1;
        for (int i = 1; i < argc; ++i) wanted = wanted || std::strcmp(argv[i], table.name) == 0;
        if (!wanted) continue;
        table.print();
        std::fflush(stdout);
        ++printed;
    }
    if (printed > 0) return 0;
    std::fprintf(stderr, "heddle_exact_table [isolated] [bundles] [leaf] [volume]\n");
    return 2;
}

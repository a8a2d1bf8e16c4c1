// host PLUGIN: loads the plug-in and lets it voxelize a polyline, like a program without heddle.
#include <dlfcn.h>
#include <cstdint>
#include <cstdio>

using VoxelizePolyline =
    std::int64_t (*)(const float*, std::int64_t, float, std::int64_t, char*, std::size_t);

int main(int argc, char** argv) {
    void* plugin = argc == 2 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : nullptr;
    void* symbol = plugin != nullptr ? dlsym(plugin, "voxelize_polyline") : nullptr;
    if (symbol == nullptr) {
        std::fprintf(stderr, "host: %s\n", dlerror());
        return 1;
    }
    const auto voxelize_polyline = reinterpret_cast<VoxelizePolyline>(symbol);
    const float points[] = {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.5f};
    char message[200] = "";
    const std::int64_t voxels = voxelize_polyline(points, 3, 0.05f, 32, message, sizeof message);
    std::printf("%lld voxels %s\n", static_cast<long long>(voxels), message);
    const std::int64_t refused = voxelize_polyline(points, 3, 0.05f, -1, message, sizeof message);
    std::printf("%lld: %s\n", static_cast<long long>(refused), message);
    return voxels > 32 && refused == -1 && message[0] != '\0' ? 0 : 1;
}

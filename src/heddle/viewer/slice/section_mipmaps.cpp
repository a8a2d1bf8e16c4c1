#include <heddle/viewer/slice/section_mipmaps.h>

#include <heddle/base/error.h>
#include <heddle/yarn/slice_image.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>

namespace heddle::viewer {
namespace {

GLuint make_array(GLenum format, std::int32_t size, std::size_t layers, GLsizei levels) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    glTextureStorage3D(id, levels, format, size, size, static_cast<GLsizei>(layers));
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER,
                        levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return id;
}

} // namespace

std::vector<std::vector<std::uint8_t>> bake_light(const Geometry& geometry,
                                                  const slice::SectionLayers& sections) {
    const auto n = static_cast<std::size_t>(sections.size);
    std::vector<std::vector<std::uint8_t>> out(sections.layers.size(),
                                               std::vector<std::uint8_t>(n * n, 255));
    for (std::size_t s = 0; s < geometry.curves.size(); ++s) {
        const YarnType* yarn = geometry.yarn_of(geometry.curves[s]);
        if (yarn == nullptr || yarn->model != YarnModel::Slice) continue;
        const Texture baked = bake_occlusion(*yarn);
        for (std::uint32_t l = sections.first[s]; l < sections.first[s + 1]; ++l) {
            const float extent = sections.layers[l].extent / yarn->model_radius;
            for (std::size_t i = 0; i < n * n; ++i) {
                const auto part = [&](std::size_t at) {
                    return ((static_cast<float>(at) + 0.5f) / static_cast<float>(n) * 2.0f - 1.0f) *
                           extent;
                };
                const float col = (part(i % n) + 1.0f) * 0.5f * static_cast<float>(baked.width);
                const float row = (1.0f - part(i / n)) * 0.5f * static_cast<float>(baked.height);
                if (!(col >= 0.0f && row >= 0.0f)) continue;
                const auto c = static_cast<std::int32_t>(col);
                const auto r = static_cast<std::int32_t>(row);
                if (c >= baked.width || r >= baked.height) continue;
                out[l][i] = baked.texels[static_cast<std::size_t>(r * baked.width + c)];
            }
        }
    }
    return out;
}

SectionMipmaps::SectionMipmaps(const slice::SectionLayers& sections,
                               const std::vector<std::vector<std::uint8_t>>& light) {
    const std::int32_t n = sections.size;
    const auto levels = static_cast<GLsizei>(std::bit_width(static_cast<std::uint32_t>(n)));
    // 16 bits: some drivers filter 8-bit textures with 8 bits, which is visible in the logarithm of
    // 1 - alpha
    color_ = make_array(GL_RGBA16, n, sections.layers.size(), levels);
    light_ = make_array(GL_R16, n, sections.layers.size(), 1);
    if (glGetError() != GL_NO_ERROR) {
        throw Error(ErrorCode::OutOfMemory,
                    str("opengl: the driver has no room for ", sections.layers.size(),
                        " sections of ", n, " x ", n, " texels"),
                    "use fewer kinds of yarn, or smaller slice images");
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t i = 0; i < sections.layers.size(); ++i) {
        const auto at = static_cast<GLint>(i);
        Texture image;
        image.width = n;
        image.height = n;
        image.channels = 4;
        image.texels = sections.layers[i].color;
        GLint level = 0;
        for (const Texture& t : shrink_slice(image)) {
            const std::int32_t size = std::max(n >> level, 1); // odd sizes: the last row is dropped
            if (level >= levels) break;
            glPixelStorei(GL_UNPACK_ROW_LENGTH, t.width);
            glTextureSubImage3D(color_, level, 0, 0, at, size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                                t.texels.data());
            ++level;
        }
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
        glTextureSubImage3D(light_, 0, 0, 0, at, n, n, 1, GL_RED, GL_UNSIGNED_BYTE,
                            light[i].data());
    }
}

SectionMipmaps::~SectionMipmaps() {
    glDeleteTextures(1, &color_);
    glDeleteTextures(1, &light_);
}

void SectionMipmaps::bind() const {
    glBindTextureUnit(1, color_);
    glBindTextureUnit(2, light_);
}

} // namespace heddle::viewer

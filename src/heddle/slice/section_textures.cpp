#include <heddle/slice/section_textures.h>

#include <heddle/base/error.h>

#include <epoxy/gl.h>

namespace heddle::slice {
namespace {

GLuint make_array(GLenum format, std::int32_t size, std::size_t layers) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    glTextureStorage3D(id, 1, format, size, size, static_cast<GLsizei>(layers));
    if (glGetError() != GL_NO_ERROR) {
        glDeleteTextures(1, &id);
        throw Error(ErrorCode::OutOfMemory,
                    str("opengl: the driver has no room for ", layers, " sections of ", size, " x ",
                        size, " texels"),
                    "use fewer kinds of yarn");
    }
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return id;
}

} // namespace

SectionTextures::SectionTextures(const SectionLayers& sections)
    : distance_(make_array(GL_R32F, sections.size, sections.layers.size())),
      color_(make_array(GL_RGBA8, sections.size, sections.layers.size())) {
    const std::int32_t n = sections.size;
    for (std::size_t i = 0; i < sections.layers.size(); ++i) {
        const auto at = static_cast<GLint>(i);
        const SectionLayer& layer = sections.layers[i];
        glTextureSubImage3D(distance_, 0, 0, 0, at, n, n, 1, GL_RED, GL_FLOAT,
                            layer.distance.data());
        glTextureSubImage3D(color_, 0, 0, 0, at, n, n, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            layer.color.data());
    }
}

SectionTextures::~SectionTextures() {
    glDeleteTextures(1, &distance_);
    glDeleteTextures(1, &color_);
}

void SectionTextures::bind() const {
    glBindTextureUnit(0, distance_);
    glBindTextureUnit(1, color_);
}

} // namespace heddle::slice

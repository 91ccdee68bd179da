#include "raster_mesa.hpp"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/osmesa.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

namespace barycert::bench {
namespace {

/// The whole of it through a pipe: false if the other end is gone.
bool move_all(int file, void* data, std::size_t size, bool out) {
    auto* bytes = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t n = out ? ::write(file, bytes, size) : ::read(file, bytes, size);
        if (n <= 0) return false;
        bytes += n;
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

/// Draws and writes its answer to the pipe. llvmpipe reads the number of threads once, when it starts: hence a process.
void draw(int file, std::int32_t side, const TexelRows& texture, const std::vector<TexturedVertex>& corners,
          int repetitions, std::size_t pictures) {
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr);
    const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<std::uint32_t> buffer(pixels);
    if (context == nullptr || !OSMesaMakeCurrent(context, buffer.data(), GL_UNSIGNED_BYTE, side, side)) return;
    char version[256] = {};
    std::snprintf(version, sizeof version, "%s, %s", reinterpret_cast<const char*>(glGetString(GL_VERSION)),
                  reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    move_all(file, version, sizeof version, true);

    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, texture.width, texture.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 texture.texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glEnable(GL_TEXTURE_2D);
    glDisable(GL_DEPTH_TEST);
    glViewport(0, 0, side, side);

    std::vector<float> positions, texture_at;
    for (const TexturedVertex& c : corners) {
        for (const double x : {(2 * c.x / side - 1) * c.w, (2 * c.y / side - 1) * c.w, 0.0, c.w})
            positions.push_back(static_cast<float>(x));
        texture_at.push_back(static_cast<float>(c.u));
        texture_at.push_back(static_cast<float>(c.v));
    }
    GLuint buffers[2];
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * positions.size()), positions.data(), GL_STATIC_DRAW);
    glVertexPointer(4, GL_FLOAT, 0, nullptr);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * texture_at.size()), texture_at.data(), GL_STATIC_DRAW);
    glTexCoordPointer(2, GL_FLOAT, 0, nullptr);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_TEXTURE_COORD_ARRAY);

    for (int k = -1; k < repetitions; ++k) {  // the first only warms up
        const auto start = std::chrono::steady_clock::now();
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
        glFinish();
        double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (k >= 0) move_all(file, &seconds, sizeof seconds, true);
    }
    glClearColor(0, 0, 0, 0);
    for (std::size_t k = 0; k < pictures; ++k) {
        glClear(GL_COLOR_BUFFER_BIT);
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * k), 3);
        glFinish();
        if (!move_all(file, buffer.data(), 4 * pixels, true)) break;
    }
    OSMesaDestroyContext(context);
}

}  // namespace

MesaAnswer draw_by_mesa(std::int32_t side, const TexelRows& texture, const std::vector<TexturedVertex>& corners,
                        int threads, int repetitions, std::size_t pictures) {
    MesaAnswer answer;
    int ends[2];
    if (pipe(ends) != 0) return answer;
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        // 0: none besides the caller's own.
        setenv("LP_NUM_THREADS", std::to_string(threads > 1 ? threads : 0).c_str(), 1);
        draw(ends[1], side, texture, corners, repetitions, pictures);
        _exit(0);
    }
    close(ends[1]);
    char version[256] = {};
    if (child > 0 && move_all(ends[0], version, sizeof version, false)) {
        answer.version = version;
        answer.seconds.resize(static_cast<std::size_t>(repetitions));
        const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        answer.pixels.resize(pictures * pixels);
        if (!move_all(ends[0], answer.seconds.data(), sizeof(double) * answer.seconds.size(), false) ||
            !move_all(ends[0], answer.pixels.data(), 4 * answer.pixels.size(), false))
            answer = {};
    }
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return answer;
}

}  // namespace barycert::bench

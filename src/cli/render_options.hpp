/// What the pictures of `barycert render` have in common: options, files, the summary.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/jobs.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

struct PictureOptions {
    std::string output, json;
    bool quiet = false;
};

/// --output (required, if asked for), --json, --quiet.
void add_picture_options(CLI::App& sub, PictureOptions& o, bool required = true);

/// --size WxH.
void add_size_option(CLI::App& sub, RasterSize& size);

/// --method and --rounding.
void add_method_options(CLI::App& sub, FillMethod& method, Rounding& rounding);

/// Checks files before the work, does it, tells its summary; returns the exit code. `work` writes the picture.
int run_picture(const PictureOptions& o, const std::vector<base::NamedFile>& inputs,
                const std::function<Result<RenderReport>()>& work);

/// The same for one scene that is drawn and written.
int run_scene(const PictureOptions& o, const std::string& picture, const std::vector<base::NamedFile>& inputs,
              const std::function<Result<Scene>()>& make);

/// What render_text and render_json say of a scene, but for the counts and the time.
RenderReport summary_of(const std::string& picture, const PictureOptions& o, const Scene& scene);

}  // namespace barycert::cli

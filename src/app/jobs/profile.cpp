#include "app/jobs/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/range.hpp"
#include "core/base/strict_math.hpp"
#include "draw/axes.hpp"
#include "draw/files.hpp"
#include "draw/picture.hpp"
#include "files/format.hpp"

namespace barycert::jobs {
namespace {

class LinePoints final : public PointSource {
public:
    explicit LinePoints(const PointLine& line) : line_(line) {}

    int dimension() const override { return static_cast<int>(line_.from.size()); }
    std::optional<std::uint64_t> count() const override { return static_cast<std::uint64_t>(line_.count); }
    Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) override {
        std::size_t some = 0;
        for (; some < max_points && next_ < line_.count; ++some, ++next_) {
            const double part =
                line_.count == 1 ? 0 : static_cast<double>(next_) / static_cast<double>(line_.count - 1);
            for (std::size_t k = 0; k < line_.from.size(); ++k)
                out.push_back(std::lerp(line_.from[k], line_.to[k], part));
        }
        return some;
    }

private:
    PointLine line_;
    std::int64_t next_ = 0;
};

using draw::Axis, draw::Curve, draw::Pixel, draw::Plot;

/// Numbers of all curves, with some room above and below.
void fit(Axis& axis, const std::vector<Curve>& curves, double Pixel::*of) {
    base::Range range;
    for (const Curve& c : curves)
        for (const Pixel& p : c.line)
            if (std::isfinite(p.y)) range.add(p.*of);
    if (range.empty()) range = {0, 1};
    const auto& [low, high] = range;
    const double room = of == &Pixel::y ? range.half() / 10 : 0;
    const double least = low == high ? (low == 0 ? 1 : std::fabs(low) / 10) : room;
    axis.low = low - least;
    axis.high = high + least;
    axis.set(draw::round_ticks(axis.low, axis.high, of == &Pixel::x ? 9 : 8));
}

/// Rows and what is drawn of them.
class Rows {
public:
    Rows(const SampleJob& job, std::vector<std::string> columns, const SampleReport& report)
        : job_(job), columns_(std::move(columns)), report_(report) {}

    void add(const TableView& rows) {
        constexpr std::size_t most = 10'000'000;
        values_.insert(values_.end(), rows.values.begin(), rows.values.end());
        const auto d = static_cast<std::size_t>(rows.dimension);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const std::span<const double> at = rows.points.subspan(d * i, d);
            double step = 0;
            for (std::size_t k = 0; k < before_.size(); ++k) step = std::hypot(step, at[k] - before_[k]);
            way_.push_back(way_.empty() ? 0 : way_.back() + step);
            before_.assign(at.begin(), at.end());
        }
        if (values_.size() > most)
            refuse_member("picture.too-large", "job.plot", job_.plot, "too many values for a plot",
                          std::to_string(most), "more", "choose fewer points or fields");
    }

    Status write() const {
        const bool over_time = !report_.steps.empty();
        const std::vector<Curve> all = over_time ? over_steps() : along_the_way();
        if (all.empty() || way_.empty())
            refuse_member("picture.empty", "job.plot", job_.plot, "nothing to plot", "fields and points",
                          "none of these");
        if (all.size() > draw::max_curves)
            refuse_member("picture.too-large", "job.plot", job_.plot, "too many curves for a plot",
                          fmt::format("at most {}", draw::max_curves), std::to_string(all.size()),
                          over_time ? "choose fewer points or fields" : "name some by job.fields");
        double beside = 0;  // the names in the legend
        for (const Curve& c : all) beside = std::max(beside, draw::text_width(c.name, 13));
        Plot plot(job_.figure.title.empty() ? job_.mesh : job_.figure.title, std::max(640.0, 476 + beside), 400,
                  76 + beside, 64);
        fit(plot.x, all, &Pixel::x);
        fit(plot.y, all, &Pixel::y);
        plot.x.title = over_time ? (report_.times.empty() ? "step" : "time") : "length from the first point";
        plot.y.title = all.size() == 1 ? all[0].name : "";
        if (!job_.figure.unit.empty()) plot.y.title += (all.size() == 1 ? " (" : "(") + job_.figure.unit + ")";
        draw_axes(plot.picture, plot.x, plot.y);
        plot.curves(all, {}, over_time);
        return draw::write_picture(job_.plot, plot.picture, job_.figure.background, job_.figure.resolution);
    }

private:
    /// One a column, broken outside the mesh.
    std::vector<Curve> along_the_way() const {
        std::vector<Curve> all;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            Curve& curve = all.emplace_back(Curve{.name = columns_[c]});
            for (std::size_t i = 0; i < way_.size(); ++i)
                curve.line.push_back({way_[i], values_[columns_.size() * i + c]});
        }
        return all;
    }

    /// One a point and field: columns are NAME@STEP.
    std::vector<Curve> over_steps() const {
        std::vector<Curve> all;
        for (std::size_t i = 0; i < way_.size(); ++i) {
            std::map<std::string, std::size_t> of_name;
            for (std::size_t c = 0; c < columns_.size(); ++c) {
                const std::size_t sign = columns_[c].rfind('@');
                if (sign == std::string::npos) continue;
                const std::string name = columns_[c].substr(0, sign), step = columns_[c].substr(sign + 1);
                const auto [at, is_new] = of_name.try_emplace(name, all.size());
                if (is_new) all.push_back({.name = way_.size() == 1 ? name : fmt::format("{}, point {}", name, i)});
                const auto n = static_cast<std::size_t>(std::ranges::find(report_.steps, step) - report_.steps.begin());
                const double x = n < report_.times.size() ? report_.times[n] : static_cast<double>(n);
                all[at->second].line.push_back({x, values_[columns_.size() * i + c]});
            }
        }
        return all;
    }

    const SampleJob& job_;
    std::vector<std::string> columns_;
    const SampleReport& report_;
    std::vector<double> values_, way_, before_;
};

}  // namespace

std::unique_ptr<PointSource> points_on(const PointLine& line) {
    return std::make_unique<LinePoints>(line);
}

Sink plotted(Sink sink, const SampleJob& job, std::vector<std::string> columns, const SampleReport& report) {
    const auto rows = std::make_shared<Rows>(job, std::move(columns), report);
    const std::shared_ptr<TableSink> to = std::move(sink);
    const auto write = [rows, to](const TableView& view) {
        rows->add(view);
        return to ? to->write(view) : Status(Done{});
    };
    return sink_of(write, [rows, to]() -> Status {
        if (to)
            if (Status committed = to->commit(); !committed) return committed;
        return rows->write();
    });
}

}  // namespace barycert::jobs

namespace barycert {

Status write_line_plot(const std::string& path, const Sampler& sampler, const PointLine& line,
                       const FigureOptions& options) try {
    const ExactEnvironment environment;
    if (!is_figure_name(path)) jobs::refuse_output(path, base::suffixes_written(base::Use::picture));
    SampleJob job;
    std::tie(job.plot, job.figure) = std::tie(path, options);
    std::vector<double> points;
    jobs::points_on(line)->read(static_cast<std::size_t>(line.count), points).value();
    Table rows = sampler.sample(points).value();
    rows.points = std::move(points);
    const SampleReport report;
    const jobs::Sink sink = jobs::plotted({}, job, rows.columns, report);
    sink->write(rows.view()).value();
    return sink->commit();
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert

/// The codes of errors: stable names by which a program decides what to do. doc/errors.md tells what each means.
///
/// Example:
///
///     #include "barycert/result.hpp"
///     const auto describe = [](const Error& error) -> std::string_view {
///         if (error.code == "file.missing") return "no such file";
///         return error.code.name();
///     };
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace barycert {

/// All codes, in the order of doc/errors.md. A code is never renamed; one that is no longer used stays here.
inline constexpr auto error_codes = std::to_array<std::string_view>({
    // Arguments in memory.
    "argument.not-finite",
    "argument.size",
    "argument.type",
    "argument.value",
    // Options of a command, members of a job, arguments in Python.
    "option.conflict",
    "option.missing",
    "option.unfit",
    "option.usage",
    "option.value",
    "rule.unfit",
    "rule.unknown",
    // Files, whatever is in them.
    "file.changed",
    "file.count",
    "file.duplicate",
    "file.empty",
    "file.encoding",
    "file.format",
    "file.missing",
    "file.number",
    "file.overwrite",
    "file.packed",
    "file.pipe",
    "file.suffix",
    "file.syntax",
    "file.too-large",
    "file.truncated",
    "file.unreadable",
    "file.unsupported",
    "file.unwritable",
    "file.version",
    // Meshes, PLCs and surfaces.
    "mesh.cell-type",
    "mesh.coordinate",
    "mesh.curved",
    "mesh.dimension",
    "mesh.empty",
    "mesh.faces",
    "mesh.fix-empty",
    "mesh.inconsistent",
    "mesh.node-count",
    "mesh.node-index",
    "mesh.node-order",
    "mesh.numbering",
    "mesh.off-plane",
    "mesh.too-large",
    "mesh.unlisted",
    "plc.defect",
    "plc.open",
    "surface.defect",
    "surface.empty",
    "surface.inconsistent",
    // Fields and labels of a mesh, steps of a series.
    "field.ambiguous",
    "field.component",
    "field.duplicate",
    "field.location",
    "field.not-finite",
    "field.size",
    "field.type",
    "field.unknown",
    "series.differs",
    "series.none",
    "series.place",
    "series.step",
    // Points, their columns, results to verify, maps of points.
    "column.duplicate",
    "column.type",
    "column.unclear",
    "column.unknown",
    "map.cells",
    "map.mesh",
    "point.degenerate",
    "point.dimension",
    "point.not-finite",
    "point.off-plane",
    "point.outside",
    "results.empty",
    // Pictures, pages, scenes.
    "picture.empty",
    "picture.failed",
    "picture.too-large",
    "scene.member",
    // Kernels, audits, witnesses.
    "audit.disagreement",
    "audit.nothing",
    "baseline.unfit",
    "family.unknown",
    "kernel.interface",
    "kernel.load",
    "kernel.name",
    "kernel.process",
    "kernel.result",
    "kernel.unfit",
    "kernel.unknown",
    "witness.member",
    "witness.mesh",
    "witness.unknown",
    // The machine, and other programs.
    "environment.inexact",
    "memory.short",
    "rank.lost",
    "rank.source",
    "run.interrupted",
    "tool.failed",
    "tool.missing",
    "internal.error",
});

/// One of error_codes. Made of a literal, it is looked up when the program is compiled: another name does not compile.
class ErrorCode {
public:
    // NOLINTNEXTLINE(google-explicit-constructor): a code is written as its name.
    consteval ErrorCode(const char* name) : name_(*std::find(error_codes.begin(), error_codes.end(), name)) {}

    /// Returns the code of that name; nothing if there is none.
    static constexpr std::optional<ErrorCode> named(std::string_view name) {
        const auto* const at = std::find(error_codes.begin(), error_codes.end(), name);
        return at == error_codes.end() ? std::nullopt : std::optional(ErrorCode(at));
    }

    constexpr std::string_view name() const { return name_; }
    friend constexpr bool operator==(ErrorCode a, ErrorCode b) { return a.name_ == b.name_; }

private:
    explicit constexpr ErrorCode(const std::string_view* listed) : name_(*listed) {}

    std::string_view name_;
};

}  // namespace barycert

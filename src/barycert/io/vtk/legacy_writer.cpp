#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkUnstructuredGridWriter.h>

#include <new>
#include <ostream>
#include <streambuf>
#include <string>

#include "barycert/base/output_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/vtk/mesh_to_grid.hpp"
#include "barycert/io/vtk/messages.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/vtu_output.hpp"
#include "barycert/vtk.hpp"

namespace barycert {
namespace {

/// Hands bytes on to a file, which keeps its errors to itself until the commit.
class FileBuffer : public std::streambuf {
public:
    explicit FileBuffer(base::OutputFile& file) : file_(file) {}

protected:
    int_type overflow(int_type c) override {
        if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
        const char byte = traits_type::to_char_type(c);
        file_.write({&byte, 1});
        return c;
    }
    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        file_.write({bytes, static_cast<std::size_t>(count)});
        return count;
    }

private:
    base::OutputFile& file_;
};

class FileStream : private FileBuffer, public std::ostream {
public:
    explicit FileStream(base::OutputFile& file) : FileBuffer(file), std::ostream(static_cast<FileBuffer*>(this)) {}
};

/// VTK's writer onto a file of ours.
class LegacyWriter : public vtkUnstructuredGridWriter {
public:
    static LegacyWriter* New();
    LegacyWriter(const LegacyWriter&) = delete;
    LegacyWriter& operator=(const LegacyWriter&) = delete;

    void set_file(base::OutputFile& file) { file_ = &file; }
    ostream* OpenVTKFile() override { return new FileStream(*file_); }  // VTK deletes it

protected:
    LegacyWriter() = default;
    ~LegacyWriter() override = default;

private:
    base::OutputFile* file_ = nullptr;
};

LegacyWriter* LegacyWriter::New() {
    VTK_STANDARD_NEW_BODY(LegacyWriter);
}

/// VTK's readers take words of up to 255 bytes.
std::string fault_of_legacy_names(const Mesh& mesh) {
    for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (const Field& field : *fields) {
            std::size_t length = 0;
            for (const char c : field.name) {
                const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
                length += plain ? 1 : 3;
            }
            if (length > 200) return "the name of field " + io::in_quotes(field.name) + " is too long for the format";
            if (field.name == "METADATA" || field.name == "NULL_ARRAY") {
                return "the name of field " + io::in_quotes(field.name) + " means something else in the format";
            }
        }
    }
    return {};
}

Status write_legacy(const Mesh& mesh, const std::string& path) {
    std::string fault = io::fault_of_mesh(mesh, io::Names::any);
    if (fault.empty()) fault = fault_of_legacy_names(mesh);
    if (!fault.empty()) return io::cannot_write("the mesh", fault, path);
    base::OutputFile file(path);
    io::Messages messages;
    {
        vtkNew<LegacyWriter> writer;
        messages.listen_to(writer);
        messages.listen_to(writer->GetExecutive());
        writer->SetFileTypeToBinary();
        // Version 4.2 counts all numbers of the cells, the lengths among them, with 32 bits.
        const std::size_t numbers = mesh.cell_count() + mesh.cells.size() + mesh.mid_nodes.size();
        writer->SetFileVersion(numbers > io::max_entities ? vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1
                                                          : vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
        writer->SetHeader("mesh");
        writer->SetInputData(io::grid_of(mesh, io::Names::any));
        writer->set_file(file);
        const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
        if (!written || !messages.first().empty()) return io::vtk_failure(path, messages.first());
    }
    return file.commit();
}

}  // namespace

Status write_vtk(const Mesh& mesh, const std::string& path) {
    const ExactEnvironment environment;
    if (path.ends_with(".vtu")) return write_vtu(mesh, path);
    if (!path.ends_with(".vtk")) {
        return Error{.what = "unknown file suffix",
                     .file = path,
                     .line = 0,
                     .expected = ".vtu or .vtk",
                     .found = {},
                     .remedy = "use one of these suffixes"};
    }
    try {
        return write_legacy(mesh, path);
    } catch (const std::bad_alloc&) {
        return io::vtk_failure(path, "too little memory");
    }
}

}  // namespace barycert

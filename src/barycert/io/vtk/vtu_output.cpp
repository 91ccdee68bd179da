#include "barycert/io/vtk/vtu_output.hpp"

#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <sstream>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/io/vtk/messages.hpp"

namespace barycert::io {
namespace {

/// VTK's writer on a stream of ours: what it makes of a string would be copied twice on the way out.
class StreamWriter : public vtkXMLUnstructuredGridWriter {
public:
    static StreamWriter* New();
    StreamWriter(const StreamWriter&) = delete;
    StreamWriter& operator=(const StreamWriter&) = delete;

    void set_stream(std::ostream& stream) { Stream = &stream; }

protected:
    StreamWriter() = default;
    ~StreamWriter() override = default;
};

StreamWriter* StreamWriter::New() {
    VTK_STANDARD_NEW_BODY(StreamWriter);
}

}  // namespace

Error vtk_failure(const std::string& path, std::string found) {
    return {.what = "VTK cannot write the mesh",
            .file = path,
            .line = 0,
            .expected = {},
            .found = std::move(found),
            .remedy = "free some memory: the file is made there first"};
}

Status write_vtu_grid(vtkUnstructuredGrid* grid, const std::string& path, std::size_t size) {
    std::string room;
    room.reserve(size);
    std::ostringstream stream(std::move(room));
    Messages messages;
    {
        vtkNew<StreamWriter> writer;
        messages.listen_to(writer);
        messages.listen_to(writer->GetExecutive());
        writer->SetDataModeToAppended();
        writer->EncodeAppendedDataOff();
        writer->SetCompressorTypeToNone();
        writer->SetHeaderTypeToUInt64();
        writer->SetInputData(grid);
        writer->set_stream(stream);
        const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
        if (!written || !stream || !messages.first().empty()) return vtk_failure(path, messages.first());
    }
    base::OutputFile file(path);
    file.write(stream.view());
    return file.commit();
}

}  // namespace barycert::io

#include "vtk/array_kinds.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkMultiProcessStream.h>
#include <vtkStringArray.h>

#include "vtk/probe_arrays.hpp"

namespace barycert::in_vtk {

namespace {

// Of a tuple, where it stands in one piece; 0 elsewhere.
std::size_t width(vtkAbstractArray& array) {
    if (array.IsNumeric() == 0 || array.GetDataType() == VTK_BIT) return 0;
    return static_cast<std::size_t>(array.GetDataTypeSize()) * static_cast<std::size_t>(array.GetNumberOfComponents());
}

bool same_place(const ArrayKind& a, const ArrayKind& b) {
    return a.named == b.named && (a.named ? a.name == b.name : a.role == b.role);
}

const ArrayKind* find(const std::vector<ArrayKind>& kinds, const ArrayKind& like) {
    for (const ArrayKind& kind : kinds)
        if (same_place(kind, like)) return &kind;
    return nullptr;
}

}  // namespace

std::string ArrayKind::text() const {
    return (named ? "the array " + name : std::string("an array without a name")) + " of " +
           std::to_string(components) + (components == 1 ? " " : " times ") + vtkImageScalarTypeNameMacro(type);
}

std::vector<ArrayKind> kinds_of(vtkDataSetAttributes& attributes, const char* but) {
    std::vector<ArrayKind> kinds;
    for (int i = 0; i < attributes.GetNumberOfArrays(); ++i) {
        vtkAbstractArray& array = *attributes.GetAbstractArray(i);
        const char* const name = array.GetName();
        if (name == nullptr && attributes.IsArrayAnAttribute(i) < 0) continue;
        // Flags of ghosts tell of the pieces, and not of the mesh.
        if (name != nullptr &&
            (std::string_view(name) == but || vtkDataSetAttributes::GhostArrayName() == std::string_view(name)))
            continue;
        ArrayKind kind{.name = name != nullptr ? name : "",
                       .named = name != nullptr,
                       .type = array.GetDataType(),
                       .components = array.GetNumberOfComponents(),
                       .role = attributes.IsArrayAnAttribute(i)};
        if (array.HasAComponentName()) {
            for (int c = 0; c < kind.components; ++c) {
                const char* const of_component = array.GetComponentName(c);
                kind.component_names.emplace_back(of_component != nullptr ? of_component : "");
            }
        }
        kinds.push_back(std::move(kind));
    }
    return kinds;
}

std::string fault_of(const std::vector<ArrayKind>& kinds) {
    for (const ArrayKind& kind : kinds) {
        const auto made = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(kind.type));
        if (made == nullptr || (made->IsNumeric() == 0 && kind.type != VTK_STRING))
            return "the source has what cannot be sent from rank to rank: " + kind.text();
    }
    return {};
}

std::string difference(const std::vector<ArrayKind>& mine, const std::vector<ArrayKind>& theirs) {
    for (const ArrayKind& kind : theirs) {
        const ArrayKind* const own = find(mine, kind);
        if (own == nullptr) return kind.text() + " is missing here";
        if (own->type != kind.type || own->components != kind.components)
            return kind.text() + " is here " + own->text();
    }
    for (const ArrayKind& kind : mine)
        if (find(theirs, kind) == nullptr) return kind.text() + " is here only";
    return {};
}

std::vector<unsigned char> to_bytes(const std::vector<ArrayKind>& kinds) {
    vtkMultiProcessStream stream;
    stream << static_cast<int>(kinds.size());
    for (const ArrayKind& kind : kinds) {
        stream << kind.name << static_cast<int>(kind.named) << kind.type << kind.components << kind.role
               << static_cast<int>(kind.component_names.size());
        for (const std::string& name : kind.component_names) stream << name;
    }
    std::vector<unsigned char> bytes;
    stream.GetRawData(bytes);
    return bytes;
}

std::vector<ArrayKind> kinds_from(const std::vector<unsigned char>& bytes) {
    vtkMultiProcessStream stream;
    stream.SetRawData(bytes);
    int count = 0;
    stream >> count;
    std::vector<ArrayKind> kinds(static_cast<std::size_t>(count));
    for (ArrayKind& kind : kinds) {
        int named = 0, names = 0;
        stream >> kind.name >> named >> kind.type >> kind.components >> kind.role >> names;
        kind.named = named != 0;
        kind.component_names.resize(static_cast<std::size_t>(names));
        for (std::string& name : kind.component_names) stream >> name;
    }
    return kinds;
}

vtkAbstractArray* find(vtkDataSetAttributes& attributes, const ArrayKind& kind) {
    if (kind.named) return attributes.GetAbstractArray(kind.name.c_str());
    return kind.role < 0 ? nullptr : attributes.GetAbstractAttribute(kind.role);
}

vtkSmartPointer<vtkAbstractArray> in_standard_layout(vtkAbstractArray& array) {
    if (array.HasStandardMemoryLayout()) return &array;
    auto copy = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(array.GetDataType()));
    copy->DeepCopy(&array);
    return copy;
}

vtkSmartPointer<vtkAbstractArray> make(const ArrayKind& kind, vtkIdType tuples, double outside) {
    auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(kind.type));
    if (kind.named) array->SetName(kind.name.c_str());
    array->SetNumberOfComponents(kind.components);
    for (std::size_t c = 0; c < kind.component_names.size(); ++c)
        array->SetComponentName(static_cast<vtkIdType>(c), kind.component_names[c].c_str());
    prepare(*array, tuples, outside);
    return array;
}

void put(vtkAbstractArray& array, vtkIdType at, std::vector<char>& bytes) {
    const auto append = [&](const void* from, std::size_t count) {
        const auto* const chars = static_cast<const char*>(from);
        bytes.insert(bytes.end(), chars, chars + count);
    };
    if (const std::size_t tuple = width(array); tuple > 0) {
        append(static_cast<const char*>(array.GetVoidPointer(0)) + tuple * static_cast<std::size_t>(at), tuple);
        return;
    }
    for (int c = 0; c < array.GetNumberOfComponents(); ++c) {
        if (auto* const texts = vtkStringArray::SafeDownCast(&array)) {
            const std::string text = texts->GetValue(at * array.GetNumberOfComponents() + c);
            const std::uint64_t size = text.size();
            append(&size, sizeof size);
            append(text.data(), text.size());
        } else {
            const char bit = vtkDataArray::SafeDownCast(&array)->GetComponent(at, c) != 0 ? 1 : 0;
            append(&bit, 1);
        }
    }
}

const char* take(vtkAbstractArray& array, vtkIdType at, const char* bytes) {
    if (const std::size_t tuple = width(array); tuple > 0) {
        std::memcpy(static_cast<char*>(array.GetVoidPointer(0)) + tuple * static_cast<std::size_t>(at), bytes, tuple);
        return bytes + tuple;
    }
    for (int c = 0; c < array.GetNumberOfComponents(); ++c) {
        if (auto* const texts = vtkStringArray::SafeDownCast(&array)) {
            std::uint64_t size = 0;
            std::memcpy(&size, bytes, sizeof size);
            bytes += sizeof size;
            texts->SetValue(at * array.GetNumberOfComponents() + c, vtkStdString(std::string(bytes, size)));
            bytes += size;
        } else {
            vtkDataArray::SafeDownCast(&array)->SetComponent(at, c, *bytes++);
        }
    }
    return bytes;
}

const char* skip(vtkAbstractArray& array, const char* bytes) {
    if (const std::size_t tuple = width(array); tuple > 0) return bytes + tuple;
    for (int c = 0; c < array.GetNumberOfComponents(); ++c) {
        std::uint64_t size = 1;
        if (array.GetDataType() == VTK_STRING) {
            std::memcpy(&size, bytes, sizeof size);
            bytes += sizeof size;
        }
        bytes += size;
    }
    return bytes;
}

}  // namespace barycert::in_vtk

#include "vtk/array_kinds.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>

#include <vtkAbstractArray.h>
#include <vtkBitArray.h>
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

vtkAbstractArray* ArrayKind::in(vtkDataSetAttributes& attributes) const {
    return array_in(attributes, named ? name.c_str() : nullptr, role);
}

vtkSmartPointer<vtkAbstractArray> ArrayKind::make(vtkIdType tuples, double outside) const {
    auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
    if (named) array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    for (std::size_t c = 0; c < component_names.size(); ++c)
        array->SetComponentName(static_cast<vtkIdType>(c), component_names[c].c_str());
    prepare(*array, tuples, outside);
    return array;
}

// Of a text its size goes first; a bit is a byte.
void ArrayTuples::put(std::size_t tuple, std::vector<char>& bytes) const {
    const auto append = [&](const char* from, std::size_t count) { bytes.insert(bytes.end(), from, from + count); };
    for (vtkAbstractArray* const array : arrays) {
        const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
        if (const std::size_t size = width(*array); size > 0) {
            append(static_cast<const char*>(array->GetVoidPointer(0)) + size * tuple, size);
            continue;
        }
        for (std::size_t at = components * tuple; at < components * (tuple + 1); ++at) {
            if (auto* const texts = vtkStringArray::SafeDownCast(array)) {
                const std::string text = texts->GetValue(static_cast<vtkIdType>(at));
                const std::uint64_t size = text.size();
                append(reinterpret_cast<const char*>(&size), sizeof size);
                append(text.data(), text.size());
            } else {
                bytes.push_back(vtkBitArray::SafeDownCast(array)->GetValue(static_cast<vtkIdType>(at)) != 0 ? 1 : 0);
            }
        }
    }
}

const char* ArrayTuples::take(std::size_t tuple, const char* bytes, bool set) {
    for (vtkAbstractArray* const array : arrays) {
        const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
        if (const std::size_t size = width(*array); size > 0) {
            if (set) std::memcpy(static_cast<char*>(array->GetVoidPointer(0)) + size * tuple, bytes, size);
            bytes += size;
            continue;
        }
        for (std::size_t at = components * tuple; at < components * (tuple + 1); ++at) {
            std::uint64_t size = 1;
            if (auto* const texts = vtkStringArray::SafeDownCast(array)) {
                std::memcpy(&size, bytes, sizeof size);
                bytes += sizeof size;
                if (set) texts->SetValue(static_cast<vtkIdType>(at), vtkStdString(std::string(bytes, size)));
            } else if (set) {
                vtkBitArray::SafeDownCast(array)->SetValue(static_cast<vtkIdType>(at), *bytes);
            }
            bytes += size;
        }
    }
    return bytes;
}

}  // namespace barycert::in_vtk

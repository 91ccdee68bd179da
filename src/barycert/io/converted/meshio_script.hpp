/// What runs in Python: a file in by meshio, raw VTU and counts out.
#pragma once

namespace barycert::io {

/// Arguments: the path, meshio's name of the format, bytes of memory and of output at most, seconds.
///
/// Descriptor 3 is for the mesh as a .vtu file, to the bit; stdout for what was read, in JSON; stderr for what meshio
/// prints. It ends with stdin, the program that asked. Modules come from no folder that the working directory decides.
inline constexpr const char* meshio_script = R"python(
import sys
sys.path = [p for p in sys.path if p]
import json, os, resource, signal, threading
from xml.sax.saxutils import quoteattr

# Threads of linear algebra would each reserve memory; lines of messages are not to be broken.
os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", COLUMNS="1000", NO_COLOR="1")

def ends_with_parent():
    os.read(0, 1)
    os.killpg(0, signal.SIGKILL)

threading.Thread(target=ends_with_parent, daemon=True).start()
path, kind, memory, output, seconds = sys.argv[1:6]
for limit, most in ((resource.RLIMIT_AS, memory), (resource.RLIMIT_FSIZE, output), (resource.RLIMIT_CPU, seconds),
                    (resource.RLIMIT_CORE, 0)):
    hard = resource.getrlimit(limit)[1]
    most = int(most) if hard == resource.RLIM_INFINITY else min(int(most), hard)
    resource.setrlimit(limit, (most, most))
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
answer = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)

def tell(**what):
    json.dump(what, answer)
    answer.flush()
    os._exit(0)

try:
    import meshio, numpy
except ImportError as error:
    tell(missing=str(error))

TYPES = dict(vertex=1, line=3, triangle=5, polygon=7, quad=9, tetra=10, hexahedron=12, wedge=13, pyramid=14, line3=21,
             triangle6=22, quad8=23, tetra10=24, hexahedron20=25, wedge15=26, pyramid13=27, quad9=28, hexahedron27=29,
             triangle7=34, line4=35, polyhedron=42)
lost, files = [], []

def opened(event, arguments):
    "Files that are read beside the one that was named, XDMF's numbers for one: nothing may replace them."
    if event == "open" and isinstance(arguments[0], (str, bytes)) and arguments[1] in (None, "r", "rb"):
        files.append(os.path.abspath(os.fsdecode(arguments[0])))

def watch_hdf5():
    "HDF5 opens files by itself."
    try:
        import h5py
    except ImportError:
        return
    class File(h5py.File):
        def __init__(self, name, *others, **named):
            files.append(os.path.abspath(os.fsdecode(name)))
            super().__init__(name, *others, **named)
    h5py.File = File

def plain(name, parts, rows):
    "One array of bytes, integers or floats, a row a node or cell; None if that would lose anything."
    parts = [numpy.asarray(p) for p in parts]
    if any(p.dtype.kind not in "biuf" or p.dtype.itemsize > 8 for p in parts):
        return lost.append(name + ", which holds no numbers of at most 64 bits")
    if not parts or sum(len(p) for p in parts if p.ndim) != rows or len({p.shape[1:] for p in parts}) != 1:
        return lost.append(name + ", which does not have one row for each")
    whole = numpy.concatenate(parts)
    if any((p.astype(whole.dtype).astype(p.dtype) != p)[p == p].any() for p in parts):
        return lost.append(name + ", whose types differ from block to block")
    if whole.dtype.kind == "b" or whole.dtype == numpy.float16:
        whole = whole.astype("u1" if whole.dtype.kind == "b" else "f4")
    return whole.reshape(rows, -1)

def write(file, mesh):
    nodes, cells = len(mesh.points), sum(len(c.data) for c in mesh.cells)
    points = plain("points", [mesh.points], nodes)
    if points is None or points.shape[1] not in (2, 3):
        raise ValueError("points of %s" % (numpy.shape(mesh.points),))
    points = points if points.dtype.kind == "f" else points.astype("f8")
    points = numpy.pad(points, ((0, 0), (0, 3 - points.shape[1])))
    for c in mesh.cells:
        if c.type not in TYPES or getattr(c.data, "ndim", 0) != 2:
            raise ValueError("%d cells of type %s" % (len(c.data), c.type))
    sizes = [c.data.shape for c in mesh.cells] or [(0, 0)]
    sections = [("Points", [("Points", points)]), ("Cells", [
        ("connectivity", numpy.concatenate([numpy.ravel(c.data) for c in mesh.cells] or [[]]).astype("i8")),
        ("offsets", numpy.cumsum(numpy.repeat([s[1] for s in sizes], [s[0] for s in sizes])).astype("i8")),
        ("types", numpy.repeat([TYPES[c.type] for c in mesh.cells] or [0], [s[0] for s in sizes]).astype("u1"))])]
    rows = {}
    for section, data, count in (("PointData", {k: [v] for k, v in mesh.point_data.items()}, nodes),
                                 ("CellData", mesh.cell_data, cells)):
        of = "point data " if section == "PointData" else "cell data "
        found = [(k, plain(of + k, v, count)) for k, v in data.items()]
        sections.append((section, [(k, v) for k, v in found if v is not None]))
        rows[section] = {k: list(v.shape) for k, v in sections[-1][1]}
    text, offset = "", 0
    for section, arrays in sections:
        text += "<%s>" % section
        for name, a in arrays:
            kind = {"f": "Float", "i": "Int", "u": "UInt"}[a.dtype.kind] + str(8 * a.dtype.itemsize)
            text += '<DataArray type="%s" Name=%s NumberOfComponents="%d" format="appended" offset="%d"/>' % (
                kind, quoteattr(name), a.shape[1] if a.ndim == 2 else 1, offset)
            offset += 8 + a.nbytes
        text += "</%s>" % section
    file.write(('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="%s" header_type="UInt64">'
                '<UnstructuredGrid><Piece NumberOfPoints="%d" NumberOfCells="%d">%s</Piece></UnstructuredGrid>'
                '<AppendedData encoding="raw">_' % (
                    "LittleEndian" if sys.byteorder == "little" else "BigEndian", nodes, cells, text)).encode())
    for _, arrays in sections:
        for _, a in arrays:
            a = numpy.ascontiguousarray(a, a.dtype.newbyteorder("="))
            file.write(numpy.uint64(a.nbytes).tobytes())
            file.write(a.data)
    file.write(b"</AppendedData></VTKFile>")
    file.flush()
    for of in ("point_sets", "cell_sets", "field_data"):
        lost.extend(of.replace("_", " ") + " " + str(k) for k in getattr(mesh, of, None) or {})
    types = {}
    for c in mesh.cells:
        types[TYPES[c.type]] = types.get(TYPES[c.type], 0) + len(c.data)
    return dict(nodes=nodes, types=types, rows=rows)

try:
    if kind in ("xdmf", "med", "h5m"):
        watch_hdf5()
    sys.addaudithook(opened)
    with os.fdopen(3, "wb") as file:
        read = write(file, meshio.read(path, file_format=kind))
except BaseException as error:
    tell(meshio=meshio.__version__, module=getattr(error, "name", None) if isinstance(error, ImportError) else None,
         error="%s: %s" % (type(error).__name__, error))
tell(meshio=meshio.__version__, lost=lost, files=files, **read)
)python";

}  // namespace barycert::io

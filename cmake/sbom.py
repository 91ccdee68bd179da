#!/usr/bin/env python3
"""Writes the bill of materials of a package, SPDX 2.3 as JSON, from what was built: the headers that the compiler read
(ninja's log), and the libraries that the binaries need (readelf); Debian's packages say whose these are, and which
version. A package whose licence is not listed below is an error: add it, after reading its copyright file.

    sbom.py --build BUILD --package NAME --version VERSION --output FILE [--notices FOLDER] PART...

PART: a program or library below BUILD; none: a package that brings others."""

import argparse
import datetime
import gzip
import json
import os
import re
import subprocess
import sys
import uuid

# By source package of Debian, as its copyright file says of the files that are used here.
LICENCES = {
    "boost1.74": "BSL-1.0",
    "boost1.83": "BSL-1.0",
    "boost-defaults": "BSL-1.0",
    "cairo": "LGPL-2.1-only OR MPL-1.1",
    "cgal": None,  # file by file: what the headers themselves say
    "cli11": "BSD-3-Clause",
    "eigen3": "MPL-2.0",
    "expat": "MIT",
    "fast-float": "Apache-2.0 OR MIT",
    "fmtlib": "MIT",
    "fontconfig": "HPND-sell-variant",
    "freetype": "FTL",
    "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "gcc-14": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later",
    "gmp": "LGPL-3.0-or-later OR GPL-2.0-or-later",
    "highway": "Apache-2.0",
    "libdeflate": "MIT",
    "libpng1.6": "libpng-2.0",
    "libxcrypt": "LGPL-2.1-or-later",
    "linux": "GPL-2.0-only WITH Linux-syscall-note",
    "lz4": "BSD-2-Clause",
    "mpfr4": "LGPL-3.0-or-later",
    "nlohmann-json3": "MIT",
    "numpy": "BSD-3-Clause",
    "openmpi": "BSD-3-Clause",
    "onetbb": "Apache-2.0",
    "paraview": "BSD-3-Clause",
    "pybind11": "BSD-3-Clause",
    "python3.11": "PSF-2.0",
    "python3.13": "PSF-2.0",
    "tetgen": "AGPL-3.0-or-later",
    "vtk9": "BSD-3-Clause",
    "xz-utils": "LicenseRef-public-domain",
    "zlib": "Zlib",
}
# Files of the project that are others' work and part of what is built from them: file, name, version, licence, file of that.
EMBEDDED = [
    ("data/fonts/DejaVuSans.ttf", "DejaVu Sans", "2.37", "Bitstream-Vera", "data/fonts/LICENSE"),
    ("data/viewer/three.min.js", "three.js", "0.160.1", "MIT", "data/viewer/LICENSE"),
]
PUBLIC_DOMAIN = {
    "licenseId": "LicenseRef-public-domain",
    "name": "Public domain",
    "extractedText": "liblzma is in the public domain: https://tukaani.org/xz/",
}


def said(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def packages_of(paths):
    """{package: paths} by dpkg, and all paths that some package has."""
    found = {}
    paths = sorted(paths)
    for first in range(0, len(paths), 500):
        some = paths[first : first + 500]
        done = subprocess.run(["dpkg", "-S", *some], capture_output=True, text=True)
        for line in done.stdout.splitlines():
            if line.startswith("diversion by"):
                continue
            owners, path = line.rsplit(": ", 1)
            for owner in owners.split(", "):
                found.setdefault(owner.split(":")[0], set()).add(path)
    known = set().union(*found.values()) if found else set()
    return found, known


def inputs_of(build, ninja, parts):
    """All that the parts are built from."""
    return said(ninja, "-C", build, "-t", "inputs", *parts).splitlines() if parts else []


def objects_of(build, ninja, parts):
    """The objects that the parts hold: of a program all that is linked, of an archive its own."""
    objects = {name for name in inputs_of(build, ninja, parts) if name.endswith(".o")}
    if all(part.endswith(".a") for part in parts):
        own = tuple(re.sub(r"lib([^/]+)\.a$", r"CMakeFiles/\1.dir/", part) for part in parts)
        objects = {name for name in objects if name.startswith(own)}
    if parts and not objects:
        sys.exit("sbom.py: no objects in " + " ".join(parts))
    return objects


def headers_of(build, ninja, objects):
    """The headers outside of the project that the objects were compiled with."""
    headers = set()
    current = None
    for line in said(ninja, "-C", build, "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            current = line.split(": #deps")[0]
        elif current in objects and line.strip().startswith("/usr/"):
            headers.add(os.path.realpath(line.strip()))
    return headers


def needed_by(build, parts):
    """The shared libraries that the parts ask the loader for."""
    sonames = set()
    for part in parts:
        if not part.endswith(".a"):
            sonames.update(re.findall(r"\(NEEDED\).*\[(.+)\]", said("readelf", "-d", os.path.join(build, part))))
    return sonames


def licence_of_cgal(headers):
    licences = set()
    for path in headers:
        with open(path, encoding="utf-8", errors="replace") as file:
            name = re.search(r"SPDX-License-Identifier: *(.+)", file.read(4000))
        # Files that only set up the package (its version, its configuration) are those of the LGPL part.
        text = name.group(1).strip() if name else "LGPL-3.0-or-later"
        licences.add(re.sub(r" OR LicenseRef-(Commercial|RFL)", "", text).strip())
        if re.search(r"(^|[^L])GPL", text):
            sys.exit(f"sbom.py: {path} is under {text}: barycert may use CGAL's LGPL packages only")
    return " AND ".join(sorted(licences))


def identifier(name):
    return "SPDXRef-Package-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    for option in ("build", "package", "version", "output"):
        parser.add_argument("--" + option, required=True)
    parser.add_argument("--ninja", default="ninja")
    parser.add_argument("--notices", help="copies the copyright files of what is compiled in to this folder")
    parser.add_argument("parts", nargs="*", metavar="PART")
    a = parser.parse_args()

    objects = objects_of(a.build, a.ninja, a.parts)
    headers = headers_of(a.build, a.ninja, objects)
    inputs = inputs_of(a.build, a.ninja, objects)
    embedded = [words for file, *words in EMBEDDED if any(path.endswith(file) for path in inputs)]
    compiled_in, known = packages_of(headers)
    unknown = sorted(headers - known)
    if unknown:
        sys.exit("sbom.py: no package of Debian has " + ", ".join(unknown[:5]))
    sonames = needed_by(a.build, a.parts)
    # A library may be there for 32 bits as well; and Debian's packages know /lib where it is a link to /usr/lib.
    places = [top + said("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip() for top in ("/lib/", "/usr/lib/")]
    linked, found = packages_of(f"{place}/{name}" for place in places for name in sonames)
    missing = sorted(sonames - {os.path.basename(path) for path in found})
    if missing:
        sys.exit("sbom.py: no package of Debian has " + ", ".join(missing))

    packages, relationships, licences = [], [], {}
    main_id = identifier(a.package)
    for name in sorted(set(compiled_in) | set(linked)):
        form = "${Version}\t${source:Package}\t${Architecture}\t${Homepage}\n"
        version, source, architecture, homepage = said("dpkg-query", "-W", "-f", form, name).splitlines()[0].split("\t")
        if source not in LICENCES:
            sys.exit(f"sbom.py: the licence of {source} (package {name}) is not listed in cmake/sbom.py")
        licence = LICENCES[source]
        if source == "cgal":
            licence = licence_of_cgal(compiled_in.get(name, ()))
        licences[name] = licence
        packages.append(
            {
                "SPDXID": identifier(name),
                "name": name,
                "versionInfo": version,
                "supplier": "Organization: Debian",
                "downloadLocation": "NOASSERTION",
                "filesAnalyzed": False,
                "licenseConcluded": licence,
                "licenseDeclared": licence,
                "copyrightText": "NOASSERTION",
                "comment": f"/usr/share/doc/{name}/copyright on Debian",
                "externalRefs": [
                    {
                        "referenceCategory": "PACKAGE-MANAGER",
                        "referenceType": "purl",
                        "referenceLocator": f"pkg:deb/debian/{name}@{version}?arch={architecture}",
                    }
                ],
                **({"homepage": homepage} if homepage else {}),
            }
        )
        if name in linked:
            relationships.append(
                {"spdxElementId": main_id, "relationshipType": "DYNAMIC_LINK", "relatedSpdxElement": identifier(name)}
            )
        if name in compiled_in:
            relationships.append(
                {
                    "spdxElementId": identifier(name),
                    "relationshipType": "BUILD_DEPENDENCY_OF",
                    "relatedSpdxElement": main_id,
                    "comment": f"{len(compiled_in[name])} of its headers are compiled in",
                }
            )

    for name, version, licence, notice in embedded:
        packages.append(
            {
                "SPDXID": identifier(name),
                "name": name,
                "versionInfo": version,
                "downloadLocation": "NOASSERTION",
                "filesAnalyzed": False,
                "licenseConcluded": licence,
                "licenseDeclared": licence,
                "copyrightText": "NOASSERTION",
                "comment": notice,
            }
        )
        relationships.append(
            {"spdxElementId": main_id, "relationshipType": "CONTAINS", "relatedSpdxElement": identifier(name)}
        )

    concluded = "Apache-2.0"
    if any("AGPL" in licence for licence in licences.values()):
        concluded = "AGPL-3.0-or-later"
    elif any("LGPL-3.0" in licences[name] for name in compiled_in if name.startswith("libcgal")):
        concluded = "Apache-2.0 AND LGPL-3.0-or-later"
    own = {
        "SPDXID": main_id,
        "name": a.package,
        "versionInfo": a.version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": concluded,
        "licenseDeclared": "Apache-2.0",
        "licenseComments": "Declared: barycert's own sources. Concluded: with what is compiled in or linked.",
        "copyrightText": "NOASSERTION",
        "primaryPackagePurpose": "LIBRARY" if all(p.endswith(".a") for p in a.parts) else "APPLICATION",
    }
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
    relationships.insert(
        0, {"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": main_id}
    )
    content = {"packages": [own, *packages], "relationships": relationships}
    # The same content has the same name; another has another.
    name = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(content, sort_keys=True))
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"{a.package}-{a.version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/{a.package}-{a.version}-{name}",
        "creationInfo": {
            "created": datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "creators": ["Tool: barycert-sbom"],
        },
        **content,
    }
    if PUBLIC_DOMAIN["licenseId"] in licences.values():
        document["hasExtractedLicensingInfos"] = [PUBLIC_DOMAIN]
    with open(a.output, "w", encoding="utf-8") as file:
        json.dump(document, file, indent=1)
        file.write("\n")
    if a.notices and a.parts:
        os.makedirs(a.notices, exist_ok=True)
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
        paths = {name: f"/usr/share/doc/{name}/copyright" for name in compiled_in}
        paths.update({name.replace(" ", "-"): os.path.join(root, notice) for name, _, _, notice in embedded})
        for name, path in paths.items():
            with open(path, "rb") as notice:
                with open(f"{a.notices}/{name}.gz", "wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=0) as file:
                    file.write(notice.read())


if __name__ == "__main__":
    main()

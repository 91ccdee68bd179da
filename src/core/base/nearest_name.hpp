/// The name that was meant by a mistyped word, also among the files of a folder.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace barycert::base {

/// Letters to insert, leave out, replace, or swap with the next (a pair once), in any case, to make the other word.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name of least edit distance from the word, the first of several; a name counts as what follows its last dot as
/// well. Empty where more than a third of the letters differ, or all, or the word has more than 100 bytes.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// `did you mean "NAME"? ` and the rest, which is alone where no name is near: a remedy for Error::remedy.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names, std::string_view rest = {});

// Lists a folder. Stands in for std::filesystem::directory_iterator, which ends the process where memory is short.

/// Names of all in a folder but "." and "..", sorted. `failed` tells why they are not all there.
std::vector<std::string> names_in_folder(const std::string& folder, std::error_code& failed);

/// The file that may be meant by a path where there is none: a near name in the same folder; empty if there is none.
std::string near_file(const std::string& path);

}  // namespace barycert::base

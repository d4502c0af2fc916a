// What compile_time.py compares the processor time of a build with: headers and templates of the standard
// library and Eigen, as the project uses them. A change here needs a new record.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Core>

std::string reference(const std::string& text) {
    std::map<std::string, std::vector<double>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        rows[line.substr(0, line.find('='))].push_back(std::stod(line));
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(4, 4);
    for (auto& [name, values] : rows) {
        std::sort(values.begin(), values.end(), std::greater<>());
        a.row(0) += Eigen::RowVector4d::Constant(values.front());
    }
    std::ostringstream out;
    out << a.transpose() << std::filesystem::path(text).filename();
    return out.str();
}

// Diagnoses withheld cases without their key: DiagnoseWithheld FOLDER RESULTFILE [THREADS] [ENGINE] [CASE]
// Every result is written as soon as it is there; cases that RESULTFILE has already are not done again.
#include "Engines.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <fstream>
#include <iostream>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

namespace
{
std::string lineOf(const msi::GapReport& report, double seconds)
{
  std::ostringstream line;
  line << msi::nameOf(report.verdict) << ','
       << (report.where.empty() ? std::string() : report.where.front().axis) << ',';
  const char* separator = "";
  for (const msi::GapAxis& axis : report.where)
  {
    line << separator << axis.axis << ':' << axis.share;
    separator = ";";
  }
  line << ',' << report.gap.rmsBefore << ',' << report.gap.rmsAfter << ',' << report.gap.noiseFloor
       << ',' << report.gap.shrink << ',' << report.gap.shrinkInterval[0] << ','
       << report.gap.shrinkInterval[1] << ',';
  separator = "";
  for (const msi::GapCause& cause : report.causes)
  {
    line << separator << cause.effect << ':' << cause.share << ':';
    for (std::size_t e = 0; e < cause.equivalent.size(); ++e)
    {
      line << (e > 0 ? "|" : "") << cause.equivalent[e];
    }
    line << ':' << cause.form << ':' << cause.shrink;
    separator = ";";
  }
  line << ',' << report.unexplained.share << ',';
  separator = "";
  for (std::size_t c = 0; c < report.candidates.size() && c < 6; ++c)
  {
    line << separator << report.candidates[c].effect << ':' << report.candidates[c].shrink;
    separator = ";";
  }
  line << ',';
  separator = "";
  for (const auto& [name, probability] : report.probabilities)
  {
    line << separator << name << ':' << probability;
    separator = ";";
  }
  line << ',';
  if (report.unexplained.rmsWithRest)
  {
    line << *report.unexplained.rmsWithRest;
  }
  line << ',';
  if (!report.nextCaptures.empty())
  {
    std::string name = report.nextCaptures.front().capture;
    std::replace(name.begin(), name.end(), ',', ';');
    line << name;
  }
  line << ',' << seconds;
  return line.str();
}

std::set<std::string> casesIn(const char* path)
{
  std::set<std::string> names;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    names.insert(line.substr(0, line.find(',')));
  }
  return names;
}
}

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: DiagnoseWithheld FOLDER RESULTFILE [THREADS] [ENGINE] [CASE]\n";
    return 2;
  }
  const std::string folder = argv[1];
  const int threads = argc > 3 ? std::stoi(argv[3]) : 1;
  const auto engine = withheld::engines().find(argc > 4 ? argv[4] : "present");
  const std::string only = argc > 5 ? argv[5] : "";
  if (engine == withheld::engines().end())
  {
    std::cerr << "there is no diagnosis named " << argv[4] << '\n';
    return 2;
  }
  const std::set<std::string> done = casesIn(argv[2]);
  std::ifstream list(folder + "/cases.csv");
  std::vector<std::pair<std::string, std::string>> cases;
  std::string line;
  std::getline(list, line);
  while (std::getline(list, line))
  {
    const std::size_t comma = line.find(',');
    const std::string name = line.substr(0, comma);
    if ((only.empty() || only == name) && done.count(name) == 0)
    {
      cases.emplace_back(name, line.substr(comma + 1));
    }
  }
  std::ofstream output(argv[2], std::ios::app);
  if (done.empty())
  {
    output << "case,verdict,axis,where,rms_before,rms_after,noise_floor,shrink,shrink_low,shrink_"
              "high,causes,unexplained,candidates,probabilities,rms_with_rest,next_capture,seconds"
           << std::endl;
  }
  std::atomic<std::size_t> next{ 0 };
  std::atomic<int> failed{ 0 };
  std::mutex console;
  const auto work = [&]
  {
    for (std::size_t i = next++; i < cases.size(); i = next++)
    {
      try
      {
        std::vector<std::string> without;
        std::istringstream names(cases[i].second);
        for (std::string name; std::getline(names, name, ';');)
        {
          without.push_back(name);
        }
        const withheld::CaseInput input = withheld::readCase(folder + "/" + cases[i].first);
        const auto start = std::chrono::steady_clock::now();
        const msi::GapReport report = engine->second(input, without);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        const std::lock_guard<std::mutex> lock(console);
        output << cases[i].first << ',' << lineOf(report, seconds.count()) << std::endl;
      }
      catch (const std::exception& error)
      {
        const std::lock_guard<std::mutex> lock(console);
        std::cerr << cases[i].first << ": " << error.what() << '\n';
        ++failed;
      }
    }
  };
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t)
  {
    pool.emplace_back(work);
  }
  for (std::thread& thread : pool)
  {
    thread.join();
  }
  return failed == 0 && output ? 0 : 1;
}

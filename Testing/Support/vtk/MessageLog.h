// What an algorithm says while it runs: the texts of its errors and warnings.
#pragma once

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkObject.h"

#include <string>
#include <vector>

namespace msi::testing
{

// Listens to an algorithm and to its executive as long as it lives; VTK then prints nothing.
class MessageLog
{
public:
  explicit MessageLog(vtkAlgorithm* algorithm)
  {
    for (vtkObject* speaker :
      { static_cast<vtkObject*>(algorithm), static_cast<vtkObject*>(algorithm->GetExecutive()) })
    {
      Tags.push_back(
        { speaker, speaker->AddObserver(vtkCommand::ErrorEvent, this, &MessageLog::onError) });
      Tags.push_back(
        { speaker, speaker->AddObserver(vtkCommand::WarningEvent, this, &MessageLog::onWarning) });
    }
  }
  ~MessageLog()
  {
    for (const auto& tag : Tags)
    {
      tag.speaker->RemoveObserver(tag.number);
    }
  }
  MessageLog(const MessageLog&) = delete;
  MessageLog& operator=(const MessageLog&) = delete;

  // The texts alone, without VTK's "ERROR: In file, line n" and the object's address.
  const std::vector<std::string>& errors() const { return Errors; }
  const std::vector<std::string>& warnings() const { return Warnings; }
  std::string firstError() const { return Errors.empty() ? std::string() : Errors.front(); }
  std::string firstWarning() const { return Warnings.empty() ? std::string() : Warnings.front(); }

private:
  struct Tag
  {
    vtkObject* speaker;
    unsigned long number;
  };

  static std::string textOf(const void* data)
  {
    std::string text = static_cast<const char*>(data);
    const auto start = text.find("): ");
    if (start != std::string::npos)
    {
      text.erase(0, start + 3);
    }
    text.erase(text.find_last_not_of(" \n") + 1);
    return text;
  }
  void onError(vtkObject*, unsigned long, void* data) { Errors.push_back(textOf(data)); }
  void onWarning(vtkObject*, unsigned long, void* data) { Warnings.push_back(textOf(data)); }

  std::vector<Tag> Tags;
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

} // namespace msi::testing

// What Flamenco's Manager does with a job type, as far as it matters here: flamenco_shim.js TYPE.js JOB.json
// prints the tasks, in the order in which they were added. As in the Manager, a job has a copy of a task, so that
// whatever is added to the task later is lost.
"use strict";
const fs = require("fs");
const vm = require("vm");

const [type, job] = process.argv.slice(2).map((file) => fs.readFileSync(file, "utf8"));
const tasks = [];

class Task {
  constructor(name, taskType) {
    Object.assign(this, { name, type: taskType, commands: [], dependencies: [] });
  }
  addCommand(command) { this.commands.push(command); }
  addDependency(task) { this.dependencies.push(task); }
}

const author = {
  Task: (name, taskType) => new Task(name, taskType),
  Command: (name, parameters) => ({ name, parameters }),
};
const sandbox = vm.createContext({ author });
vm.runInContext('"use strict";' + type, sandbox, { filename: "job_type.js" });
const { settings } = JSON.parse(job);
const known = vm.runInContext("JOB_TYPE", sandbox).settings;
for (const setting of known) {
  if (setting.required && settings[setting.key] === undefined) throw new Error("the job lacks " + setting.key);
}
for (const key of Object.keys(settings)) {
  if (!known.some((setting) => setting.key === key)) throw new Error("no setting is called " + key);
}
sandbox.job = {
  settings,
  addTask: (task) => tasks.push({ ...task, commands: [...task.commands],
                                  dependencies: task.dependencies.map((one) => one.name) }),
};
vm.runInContext("compileJob(job)", sandbox);
console.log(JSON.stringify(tasks));

// Starts `vv lsp` beside the editor, and the modeler with the program that is shown.

const { spawn } = require("node:child_process");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function command() {
  return vscode.workspace.getConfiguration("vv").get("path") || "vv";
}

async function openInModeler() {
  const editor = vscode.window.activeTextEditor;
  if (!editor || editor.document.languageId !== "vv") return;
  // The window reads the file, and reads it again whenever it is saved.
  if (!(await editor.document.save())) return;
  const modeler = spawn(command(), [editor.document.fileName], { detached: true, stdio: "ignore" });
  modeler.on("error", (error) => vscode.window.showErrorMessage(`vv does not start: ${error.message}`));
  modeler.unref();
}

async function activate(context) {
  context.subscriptions.push(vscode.commands.registerCommand("vv.open", openInModeler));
  client = new LanguageClient(
    "vv",
    "vv",
    { command: command(), args: ["lsp"] },
    { documentSelector: [{ language: "vv" }] },
  );
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(`\`${command()} lsp\` does not start; set \`vv.path\`: ${error.message}`);
  }
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };

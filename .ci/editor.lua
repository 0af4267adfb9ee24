-- A conversation of a real editor with `vv lsp`, by Neovim's own client: one step for each thing that the server does, as
-- somebody does it by hand. Runs in a folder with main.vv and lib.vv; ends with an error where the editor does not show
-- what it should. `vv` is the path in $VV.
local timeout = 20000

local function fail(what, got)
  io.stderr:write('editor: ' .. what .. ' fails: ' .. vim.inspect(got) .. '\n')
  vim.cmd('cquit 1')
end
local function check(what, right, got)
  if not right then fail(what, got) end
  io.stdout:write('editor: ' .. what .. '\n')
end
local function wait(what, reached, got)
  if not vim.wait(timeout, reached, 20) then fail('waiting for ' .. what, got and got() or nil) end
end

vim.o.swapfile = false
vim.o.hidden = true
vim.o.showmode = false
vim.cmd('edit main.vv')
local main = vim.api.nvim_get_current_buf()
-- Told of each change at once: this script is quicker than hands.
local flags = { debounce_text_changes = 0 }
local client = vim.lsp.start_client({ name = 'vv', cmd = { vim.env.VV, 'lsp' }, root_dir = vim.fn.getcwd(), flags = flags })
check('the server starts', client ~= nil)
vim.lsp.buf_attach_client(main, client)
wait('the server', function()
  local known = vim.lsp.get_client_by_id(client)
  return known ~= nil and known.initialized and vim.lsp.buf_is_attached(main, client)
end)

local function lines() return vim.api.nvim_buf_get_lines(0, 0, -1, false) end
local function text() return table.concat(lines(), '\n') end
-- The cursor onto this word of the text.
local function to(word)
  vim.fn.cursor(1, 1)
  if vim.fn.search('\\V\\C\\<' .. word .. '\\>', 'c') == 0 then fail('finding ' .. word, text()) end
end
local function problems(buffer)
  return vim.tbl_map(function(d) return (d.lnum + 1) .. ': ' .. d.message end, vim.diagnostic.get(buffer or 0))
end
-- What stands in the windows that float over the text.
local function floating()
  for _, window in ipairs(vim.api.nvim_list_wins()) do
    if vim.api.nvim_win_get_config(window).relative ~= '' then
      return table.concat(vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false), '\n')
    end
  end
  return ''
end

-- Problems, while it is typed.
wait('no problems', function() return #problems() == 0 end, problems)
to('half')
vim.cmd('normal! ciwhelf')
wait('a problem', function() return #problems() == 1 end, problems)
check('problems are told as one types', problems()[1]:find('^4: there is no function `helf`') ~= nil, problems())
vim.cmd('normal! ciwhalf')
wait('its end', function() return #problems() == 0 end, problems)
check('and are gone when they are mended', true)

-- What is under the pointer.
to('half')
vim.lsp.buf.hover()
wait('an explanation', function() return floating() ~= '' end)
check('names are explained under the pointer', floating():find('double half(double x)', 1, true) ~= nil, floating())
vim.cmd('normal! l')
vim.api.nvim_exec_autocmds('CursorMoved', {})

-- To where it is declared, in another file, and back.
to('half')
vim.lsp.buf.definition()
wait('the other file', function() return vim.fn.expand('%:t') == 'lib.vv' end)
check('a name leads to its declaration', vim.fn.getline('.'):find('^double half') ~= nil, vim.fn.getline('.'))
local lib = vim.api.nvim_get_current_buf()
vim.lsp.buf_attach_client(lib, client)
vim.api.nvim_set_current_buf(main)

-- All places where it is used.
to('half')
vim.lsp.buf.references({ includeDeclaration = true })
wait('places', function() return #vim.fn.getqflist() == 2 end, vim.fn.getqflist)
check('uses are found in all files', true)
vim.cmd('cclose')

-- Another name, everywhere.
vim.api.nvim_set_current_buf(main)
to('half')
vim.lsp.buf.rename('middle')
wait('the new name', function() return text():find('middle(1.0)', 1, true) ~= nil end, text)
vim.api.nvim_set_current_buf(lib)
check('a name is changed wherever it means the same', text():find('double middle(double x)', 1, true) ~= nil, text())
vim.api.nvim_set_current_buf(main)
wait('no problems with it', function() return #problems() == 0 and #problems(lib) == 0 end, problems)

-- What is in the text.
vim.fn.setqflist({})
vim.lsp.buf.document_symbol()
local function outline()
  return vim.tbl_map(function(item) return item.text end, vim.fn.getqflist())
end
wait('an outline', function() return #outline() > 0 end, outline)
local symbols = table.concat(outline(), '\n')
check('a text is listed', symbols:find('amount') ~= nil and symbols:find('step') ~= nil, outline())
vim.cmd('cclose')
vim.api.nvim_set_current_buf(main)

-- Laid out.
vim.fn.search('forall')
vim.cmd('normal! >>')
local crooked = text()
if vim.lsp.buf.format then vim.lsp.buf.format({ timeout_ms = timeout }) else vim.lsp.buf.formatting_sync({}, timeout) end
check('a text is laid out', text() ~= crooked and text():find('\n  forall v in S', 1, true) ~= nil, text())

-- What can stand at the cursor, offered and taken by keys: they are read when this script has ended.
vim.bo.omnifunc = 'v:lua.vim.lsp.omnifunc'
vim.o.completeopt = 'menu,menuone,noinsert'
to('middle')
local function keys(which) vim.api.nvim_feedkeys(vim.api.nvim_replace_termcodes(which, true, false, true), 'n', false) end
local function words()
  return vim.tbl_map(function(item) return item.word end, vim.fn.complete_info({ 'items' }).items)
end
local began = vim.loop.now()
local function later(reached, what, next)
  vim.defer_fn(function()
    if reached() then next()
    elseif vim.loop.now() - began > timeout then fail('waiting for ' .. what, { words(), text() })
    else later(reached, what, next) end
  end, 30)
end
keys('ciwmidd<C-x><C-o>')
later(function() return vim.tbl_contains(words(), 'middle') end, 'what can stand here', function()
  check('what can stand somewhere is offered', true)
  keys('<C-y><Esc>')
  later(function() return vim.fn.mode() == 'n' and text():find('middle(1.0)', 1, true) ~= nil end, 'the word', function()
    check('and taken', true)
    vim.lsp.stop_client(client)
    wait('the end', function()
      local known = vim.lsp.get_client_by_id(client)
      return known == nil or known.is_stopped()
    end)
    check('the server ends', true)
    vim.cmd('qall!')
  end)
end)
